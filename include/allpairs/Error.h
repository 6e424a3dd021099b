// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace allpairs {

/// Base of everything that Allpairs throws on purpose: bad data, bad settings, bad files.
///
/// The library never prints, aborts or shortens a result; it throws one of these, whose `what()` is one line that
/// names the box, model, option, or file and place at fault.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A setting or an argument that makes no sense: a span of the wrong length, a NaN distance, a reversed region.
class InvalidArgument : public Error {
 public:
  using Error::Error;
};

/// A box or a per-box value that cannot be used; `index()` says which one.
class InvalidBox : public Error {
 public:
  InvalidBox(std::size_t index, const std::string& message) : Error(message), m_index(index) {}

  [[nodiscard]] std::size_t index() const noexcept { return m_index; }

 private:
  std::size_t m_index;
};

/// There are more pairs than the caller allowed; `count()` is how many had been found when the limit was passed.
class LimitExceeded : public Error {
 public:
  LimitExceeded(std::uint64_t count, const std::string& message) : Error(message), m_count(count) {}

  [[nodiscard]] std::uint64_t count() const noexcept { return m_count; }

 private:
  std::uint64_t m_count;
};

/// A file that is missing, unreadable, or malformed; `line()` and `column()` count from 1, 0 where there is none.
class FileError : public Error {
 public:
  FileError(const std::filesystem::path& path, const std::string& problem, std::size_t line = 0, std::size_t column = 0)
      : Error(describe(path, problem, line, column)), m_path(path), m_line(line), m_column(column) {}

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return m_path; }
  [[nodiscard]] std::size_t line() const noexcept { return m_line; }
  [[nodiscard]] std::size_t column() const noexcept { return m_column; }

 private:
  static std::string describe(const std::filesystem::path& path, const std::string& problem, std::size_t line,
                              std::size_t column) {
    std::string text = path.string();
    if (line != 0) text += ':' + std::to_string(line);
    if (line != 0 && column != 0) text += ':' + std::to_string(column);
    return text + ": " + problem;
  }

  std::filesystem::path m_path;
  std::size_t m_line;
  std::size_t m_column;
};

}  // namespace allpairs
