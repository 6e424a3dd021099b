// SPDX-License-Identifier: MIT
#include "cli/Terminal.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "cli/Text.h"

namespace allpairs::app {
namespace {

/// Whether a byte of UTF-8 goes on with a character.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

/// Where the character of a number begins.
std::size_t placeOf(std::string_view text, std::size_t character) {
  std::size_t place = 0;
  for (; place < text.size(); ++place) {
    if (!continues(text[place]) && character-- == 0) return place;
  }
  return place;
}

}  // namespace

std::optional<std::size_t> terminalWidth(int descriptor) {
  struct winsize size {};
  if (::isatty(descriptor) != 1 || ::ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return size.ws_col;
}

void sayWritten(const std::string& what, const std::filesystem::path& file) {
  if (::isatty(STDOUT_FILENO) != 1) return;
  fmt::print("{} → {}\n", what, printable(file.string()));
}

bool wantsColour(std::string_view word, bool isTerminal) {
  if (word == "always" || word == "never") return word == "always";
  const char* none = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool isDumb = terminal != nullptr && std::string_view(terminal) == "dumb";
  return isTerminal && !isDumb && (none == nullptr || *none == '\0');
}

std::size_t columnsOf(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

std::string elided(const std::string& text, std::size_t width) {
  const std::size_t columns = columnsOf(text);
  if (columns <= width) return text;
  if (width == 0) return {};
  const std::size_t tail = (width - 1) / 2;
  const std::size_t head = width - 1 - tail;
  return text.substr(0, placeOf(text, head)) + "…" + text.substr(placeOf(text, columns - tail));
}

std::string padded(const std::string& text, std::size_t width) {
  const std::size_t columns = columnsOf(text);
  return columns < width ? text + std::string(width - columns, ' ') : text;
}

std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    const bool fits = column == 0 || column + 1 + columnsOf(word) <= width;
    if (!fits) column = 0;
    if (!result.empty()) result += fits ? ' ' : '\n';
    column += (column == 0 ? 0 : 1) + columnsOf(word);
    result += word;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace allpairs::app
