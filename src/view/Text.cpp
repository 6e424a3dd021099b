// SPDX-License-Identifier: MIT
#include "Text.h"

#include <nlohmann/json.hpp>

namespace allpairs::view {
namespace {

/// The text with what is not UTF-8 replaced. The writer of JSON does it, whose quoting is undone again.
std::string validUtf8(std::string_view text) {
  using AnyJson = nlohmann::json;
  return AnyJson::parse(AnyJson(text).dump(-1, ' ', false, AnyJson::error_handler_t::replace)).get<std::string>();
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : validUtf8(text)) {
    if (c == '\t' || c == '\n') {
      result += ' ';
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += "\xEF\xBF\xBD";
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
  return !text.empty() && kFormulaBegins.find(text.front()) != std::string_view::npos;
}

}  // namespace allpairs::view
