// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "allpairs/StopFlag.h"

namespace allpairs::scene {

/// The progress of a reader: `done` of `total` steps, and what it is reading. `total` is 0 if unknown.
struct Progress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::filesystem::path file;
};

/// Half of the machine's memory, in bytes; the greatest number where the system does not tell.
[[nodiscard]] std::uint64_t halfOfMemory() noexcept;

/// Which SOFA a scene is read as: docs/scenes.md has the differences.
enum class SofaVersion {
  FromScene,  ///< By the components that the scene names: Sofa2612 where one is known to that alone.
  Sofa2006,   ///< 20.06 and before.
  Sofa2612,   ///< 22.06 to 26.12.
};

/// The one that reads scenes as a version of SOFA does, called by its year and month as in "24.06" or "v20.06.00".
///
/// Bad input: what is no version, and a version between the two or after them, throws InvalidArgument.
[[nodiscard]] SofaVersion sofaVersionOf(std::string_view version);

/// How input is read; the defaults suit files that name no others.
struct ReadOptions {
  /// Folders that are searched, in order, for the files that a scene names, after the scene's own folder.
  std::vector<std::filesystem::path> searchRoots{};

  /// Skip models that cannot be placed, with a remark, instead of throwing.
  bool partial = false;

  /// Of a folder, read the mesh files of the folders within it as well, at any depth. Links to folders are passed over.
  bool recursive = false;

  /// Read files that an input names in any folder. Otherwise only those in its own folder, in the search roots, and
  /// below these, after symbolic links are resolved; any other is an error.
  bool allowOutside = false;

  /// The maximum memory, in bytes, for reading an input. The default, 0, means half of the machine's memory, and at
  /// most 256 MiB plus 256 bytes for each byte of the files that are read. It also bounds time: of points, elements and
  /// the like, at most 32 pairs are compared for each byte of it, and faces are cut with 4 tests for each byte.
  std::uint64_t maxMemory = 0;

  SofaVersion sofa = SofaVersion::FromScene;

  /// If set, reading throws Stopped soon after this is set. Not owned.
  const StopFlag* stop = nullptr;

  /// Called now and then with the progress; may be empty.
  std::function<void(const Progress&)> progress{};
};

}  // namespace allpairs::scene
