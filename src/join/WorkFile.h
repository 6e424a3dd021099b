// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "allpairs/StopFlag.h"

namespace allpairs::join {

/// A file of the work folder, written and read at any position.
///
/// Bad input: what the system refuses throws FileError, a full disk among it.
/// Threads:   read() and write() from any number of threads, of different parts.
class WorkFile {
 public:
  enum class Mode {
    Create,        ///< Removes what is there, which may be a link.
    CreateOrOpen,  ///< Takes what is there, as it is; a link throws FileError.
    Open,
  };

  WorkFile() = default;
  WorkFile(const std::filesystem::path& path, Mode mode);
  /// Creates a file, or opens the one that is there; none where its folder has gone.
  [[nodiscard]] static std::optional<WorkFile> unlessFolderIsGone(const std::filesystem::path& path);
  ~WorkFile();
  WorkFile(WorkFile&& other) noexcept;
  WorkFile& operator=(WorkFile&& other) noexcept;
  WorkFile(const WorkFile&) = delete;
  WorkFile& operator=(const WorkFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return m_path; }

  void write(std::uint64_t position, const void* bytes, std::size_t count) const;

  /// A file that ends before throws FileError.
  void read(std::uint64_t position, void* bytes, std::size_t count) const;

  /// Sets who may read and write it; false where that cannot be.
  [[nodiscard]] bool setPermissions(std::filesystem::perms permissions) const noexcept;

  /// Returns when what was written is on the disk.
  void sync() const;

  /// Takes the lock of the file, which ends with it, also where the process is killed; false if another has it.
  [[nodiscard]] bool lock() const;

  /// Whether its path still leads to it: nobody has removed or replaced it.
  [[nodiscard]] bool isThere() const;

 private:
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path m_path;
  int m_descriptor = -1;
};

/// Whether there is no such file; false where the system cannot say.
[[nodiscard]] bool isAbsent(const std::filesystem::path& path) noexcept;

/// The checksum of a part of a file; none if the file ends before.
[[nodiscard]] std::optional<std::uint64_t> checksumOf(const WorkFile& file, std::uint64_t position, std::uint64_t count,
                                                      const StopFlag* stop = nullptr);

}  // namespace allpairs::join
