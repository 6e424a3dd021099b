// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace allpairs::view {

/// The text with U+FFFD in the place of bytes that are not UTF-8.
[[nodiscard]] std::string validUtf8(std::string_view text);

/// The text with only characters that XML and HTML have: tabs and line feeds become spaces; control characters and
/// bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string printable(std::string_view text);

/// The printable text, escaped for HTML: between tags and in quoted attributes.
[[nodiscard]] std::string escapeHtml(std::string_view text);

/// Whether a spreadsheet may take a cell with this text for a formula, or would without the apostrophes before it. Such
/// a text is written with one more apostrophe, which is taken off when it is read.
[[nodiscard]] bool looksLikeFormula(std::string_view text);

}  // namespace allpairs::view
