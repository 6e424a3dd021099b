// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace allpairs::app {

/// Where a command's result goes: standard output, or a file that appears only when it is complete.
///
/// A file is written beside its final place, under another name, and renamed by commit(). Without commit() nothing is
/// left behind. A path that is no regular file, such as a pipe or a device, is written directly.
/// Bad input: whatever can't be opened or written throws FileError; a pipe that nobody reads throws ClosedPipe.
class Output {
 public:
  explicit Output(const std::optional<std::filesystem::path>& path);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  [[nodiscard]] bool isTerminal() const;
  void write(std::string_view bytes);

  /// The result is complete: puts the file in its place.
  void commit();

 private:
  void openBeside();
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path m_target;  ///< Empty for standard output.
  std::filesystem::path m_temporary;
  int m_descriptor = -1;
};

}  // namespace allpairs::app
