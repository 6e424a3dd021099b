// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace allpairs::app {

/// Inputs that can be read only once, from the beginning to the end, as files that readers may search: standard input,
/// as "-" or /dev/stdin, and pipes are written to a folder of their own among the temporary files, which goes with this
/// object.
class SpooledInputs {
 public:
  /// Replaces such inputs by their files. What is in one is said by `format`, an extension such as "csv"; empty: by its
  /// name.
  ///
  /// Bad input: standard input twice, or a format that nobody says, throws UsageError; what cannot be read or written
  ///            FileError.
  SpooledInputs(std::vector<std::string>& paths, const std::string& format);
  ~SpooledInputs();
  SpooledInputs(const SpooledInputs&) = delete;
  SpooledInputs& operator=(const SpooledInputs&) = delete;
  SpooledInputs(SpooledInputs&&) = delete;
  SpooledInputs& operator=(SpooledInputs&&) = delete;

  /// What the user calls a file: "standard input", the pipe, of which one without a name is "pipe" or "pipe 2" by its
  /// place among such inputs, or the file itself.
  [[nodiscard]] std::filesystem::path shown(const std::filesystem::path& file) const;
  /// A text with what the user calls the files in it.
  [[nodiscard]] std::string shownIn(std::string text) const;

  /// Whether a file is what one of them was read from: standard input may be a file.
  [[nodiscard]] bool isSource(const std::filesystem::path& file) const;

 private:
  struct Spooled {
    std::filesystem::path folder;  ///< Its own.
    std::filesystem::path file;
    std::filesystem::path shown;
    std::optional<std::pair<dev_t, ino_t>> source{};  ///< The regular file that it was read from.
  };

  void spool(std::string& path, const std::string& format);
  void makeFolder();
  void removeAll() noexcept;

  std::filesystem::path m_folder;
  std::vector<Spooled> m_files;
};

/// Does work that reads inputs with those that can be read only once spooled. Its FileErrors and UsageErrors name what
/// the user named.
void withSpooledInputs(std::vector<std::string>& paths, const std::string& format,
                       const std::function<void(const SpooledInputs&)>& work);

}  // namespace allpairs::app
