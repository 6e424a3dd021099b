// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace allpairs::app {

/// Where a command's result goes: standard output, or a file that appears only when it is complete.
///
/// A file is written beside its final place, under another name, and renamed by commit(). Without commit() nothing is
/// left behind, nor by a signal that ends the program: where the system has files without a name, it gets one only
/// when it is complete. A path that is no regular file, such as a pipe or a device, is written directly, and so is one
/// that means a descriptor of the program, such as /dev/stdout.
/// Bad input: an output that cannot be opened or written throws FileError; a pipe without a reader throws ClosedPipe.
class Output {
 public:
  explicit Output(const std::optional<std::filesystem::path>& path);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  [[nodiscard]] bool isTerminal() const;
  /// Whether it becomes a file, beside which others may lie: no pipe, no device, and no descriptor.
  [[nodiscard]] bool isFile() const { return m_isNameless || !m_temporary.empty(); }

  /// Of a result whose size is known before it is made: a disk with less room than that is an error at once.
  void requireRoom(std::uint64_t bytes) const;

  void write(std::string_view bytes);

  /// Returns when what was written to a file is on the disk.
  void sync() const;

  /// All of commit() but to put the file in its place, which then takes no memory: of files that appear together.
  void complete();

  /// The result is complete: puts the file in its place.
  void commit();

 private:
  Output() = default;
  void openTarget();
  void openBeside();
  void openNamed(const std::filesystem::path& place);
  void giveName();
  [[nodiscard]] std::filesystem::path name() const;
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path m_target;  ///< Empty for standard output.
  std::string m_temporary;         ///< Where the file is until it is complete; empty while it has no name.
  std::string m_place;             ///< Where it belongs; empty until complete().
  bool m_isNameless = false;
  int m_descriptor = -1;
};

}  // namespace allpairs::app
