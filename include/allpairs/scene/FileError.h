// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

#include "allpairs/Error.h"

namespace allpairs {

/// A file that is missing, unreadable, or malformed; `line()` and `column()` count from 1, or are 0 if unknown.
class FileError : public Error {
 public:
  FileError(const std::filesystem::path& path, const std::string& problem, std::size_t line = 0, std::size_t column = 0)
      : Error(describe(path, problem, line, column)),
        m_path(path),
        m_problem(oneLine(problem)),
        m_line(line),
        m_column(column) {}

  /// Of a file that the system does not open, read or write, for the reason `code`.
  FileError(const std::filesystem::path& path, const std::string& problem, std::error_code code)
      : FileError(path, problem) {
    m_code = code;
  }

  /// The same, with what the system says behind what could not be done: "cannot be opened: Permission denied".
  [[nodiscard]] static FileError ofSystem(const std::filesystem::path& path, const std::string& action,
                                          std::error_code code) {
    return {path, action + ": " + code.message(), code};
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return m_path; }
  /// The problem, without the position.
  [[nodiscard]] const std::string& problem() const noexcept { return m_problem; }
  [[nodiscard]] std::size_t line() const noexcept { return m_line; }
  [[nodiscard]] std::size_t column() const noexcept { return m_column; }
  /// What the system says, such as std::errc::no_such_file_or_directory; none where the content is what is wrong.
  [[nodiscard]] std::error_code code() const noexcept { return m_code; }

 private:
  static std::string describe(const std::filesystem::path& path, const std::string& problem, std::size_t line,
                              std::size_t column) {
    std::string text = path.string();
    if (line != 0) text += ':' + std::to_string(line);
    if (line != 0 && column != 0) text += ':' + std::to_string(column);
    return text + ": " + problem;
  }

  std::filesystem::path m_path;
  std::string m_problem;
  std::size_t m_line;
  std::size_t m_column;
  std::error_code m_code;
};

}  // namespace allpairs
