// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace allpairs::scene {

/// How far a reader has come: `done` of `total` steps, and what it reads now. `total` is 0 where it isn't known.
struct Progress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::filesystem::path file;
};

/// How input is read; the defaults are right for files that stand alone.
struct ReadOptions {
  /// Folders that are searched, in order, for the files that a scene names, after the scene's own folder.
  std::vector<std::filesystem::path> searchRoots{};

  /// Leave out what can't be placed, with a remark, where it would otherwise be an error.
  bool partial = false;

  /// Read files that an input names wherever they are. Otherwise only those in its own folder, in the search roots, and
  /// below these, symbolic links resolved; any other is an error.
  bool allowOutside = false;

  /// The most memory, in bytes, that reading an input may take. By default, 0, half of what the machine has, and never
  /// more than 256 MiB plus 256 bytes for each byte of the files that are read.
  std::uint64_t maxMemory = 0;

  /// Told now and then how far reading has come; may be empty.
  std::function<void(const Progress&)> progress{};
};

}  // namespace allpairs::scene
