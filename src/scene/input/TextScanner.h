// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "allpairs/StopFlag.h"

namespace allpairs::scene {

/// Reads a text word by word and says at which line it went wrong. What stands there it does not repeat: a scene may
/// name any file for a mesh, and its messages must not show what is in it.
class TextScanner {
 public:
  /// Reads the whole file; throws FileError. This and all below throws Stopped soon after a flag that is given is set.
  explicit TextScanner(const std::filesystem::path& path, const StopFlag* stop);
  /// The same of a text that was read.
  TextScanner(const std::filesystem::path& path, std::string text, const StopFlag* stop);

  /// The next word, or an empty one at the end of the file.
  std::string_view word();
  /// The next word of this line, or an empty one at its end.
  std::string_view wordInLine();
  double number();
  /// Three numbers.
  std::array<double, 3> point();
  std::int64_t integer();
  void expect(std::string_view word);
  void skipLine();
  /// Skips blanks and the lines that begin with '#'.
  void skipComments();
  /// Takes exactly that many bytes; throws if there are fewer.
  std::string_view bytes(std::size_t count);

  /// Whether that is what is read next.
  [[nodiscard]] bool startsWith(std::string_view bytes) const { return rest().starts_with(bytes); }

  /// How many bytes lie before what is read next.
  [[nodiscard]] std::size_t position() const { return m_position; }
  /// Goes back, or on, to such a place.
  void seek(std::size_t position) { m_position = position; }

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  [[nodiscard]] std::string_view rest() const { return std::string_view{m_text}.substr(m_position); }

  std::filesystem::path m_path;
  std::string m_text;
  const StopFlag* m_stop;
  std::size_t m_position = 0;
  std::size_t m_wordStart = 0;
};

}  // namespace allpairs::scene
