// SPDX-License-Identifier: MIT
#include "Text.h"

#include <nlohmann/json.hpp>

namespace allpairs::view {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// U+FFFE and U+FFFF, which XML does not allow.
bool isNonCharacter(std::string_view bytes) { return bytes == "\xEF\xBF\xBE" || bytes == "\xEF\xBF\xBF"; }

}  // namespace

// The writer of JSON replaces what is none, and its quoting is undone again.
std::string validUtf8(std::string_view text) {
  using AnyJson = nlohmann::json;
  return AnyJson::parse(AnyJson(text).dump(-1, ' ', false, AnyJson::error_handler_t::replace)).get<std::string>();
}

std::string printable(std::string_view text) {
  const std::string valid = validUtf8(text);
  std::string result;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    const char c = valid[i];
    if (c == '\t' || c == '\n') {
      result += ' ';
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += kReplacement;
    } else if (isNonCharacter(std::string_view(valid).substr(i, 3))) {
      result += kReplacement;
      i += 2;
    } else {
      result += c;
    }
  }
  return result;
}

std::string escapeHtml(std::string_view text) {
  std::string result;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

bool looksLikeFormula(std::string_view text) {
  constexpr std::string_view kFormulaBegins = "=+-@\t\r";
  const std::size_t begin = text.find_first_not_of('\'');
  return begin != std::string_view::npos && kFormulaBegins.find(text[begin]) != std::string_view::npos;
}

}  // namespace allpairs::view
