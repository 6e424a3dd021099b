// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace allpairs::scene::sofa {

/// Reads a text word by word and says at which line it went wrong. What stands there it does not repeat: a scene may
/// name any file for a mesh, and its messages must not show what is in it.
class TextScanner {
 public:
  /// Reads the whole file; throws FileError.
  explicit TextScanner(const std::filesystem::path& path);

  [[nodiscard]] bool atEnd();
  /// The next word, or an empty one at the end of the file.
  std::string_view word();
  /// The next word of this line, or an empty one at its end.
  std::string_view wordInLine();
  double number();
  std::int64_t integer();
  void expect(std::string_view word);
  void skipLine();
  /// Takes exactly that many bytes; throws if there are fewer.
  std::string_view bytes(std::size_t count);

  [[nodiscard]] double toNumber(std::string_view word) const;
  [[nodiscard]] std::int64_t toInteger(std::string_view word) const;
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  std::string_view take(std::size_t begin);

  std::filesystem::path m_path;
  std::string m_text;
  std::size_t m_position = 0;
  std::size_t m_wordStart = 0;
};

}  // namespace allpairs::scene::sofa
