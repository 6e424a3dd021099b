// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace allpairs::scene {

/// Appends a character by its code in Unicode, up to 10FFFF in hexadecimal.
inline void appendUtf8(std::string& to, std::uint32_t code) {
  const auto tail = [&](unsigned shift) { to.push_back(static_cast<char>(0x80U | ((code >> shift) & 0x3FU))); };
  if (code < 0x80) {
    to.push_back(static_cast<char>(code));
  } else if (code < 0x800) {
    to.push_back(static_cast<char>(0xC0U | (code >> 6U)));
    tail(0);
  } else if (code < 0x10000) {
    to.push_back(static_cast<char>(0xE0U | (code >> 12U)));
    tail(6);
    tail(0);
  } else {
    to.push_back(static_cast<char>(0xF0U | (code >> 18U)));
    tail(12);
    tail(6);
    tail(0);
  }
}

/// The number of so many hexadecimal digits at a place of a text; nothing where they are not there.
[[nodiscard]] inline std::optional<std::uint32_t> hexAt(std::string_view text, std::size_t at, std::size_t digits) {
  if (text.size() < at + digits) return std::nullopt;
  std::uint32_t code = 0;
  const char* const first = text.data() + at;
  const auto [end, problem] = std::from_chars(first, first + digits, code, 16);
  return problem == std::errc() && end == first + digits ? std::optional(code) : std::nullopt;
}

/// Whether a code is the first half of a character of two, as UTF-16 has them.
[[nodiscard]] constexpr bool isHighHalf(std::uint32_t code) { return code >= 0xD800 && code < 0xDC00; }

/// Whether it is the second.
[[nodiscard]] constexpr bool isLowHalf(std::uint32_t code) { return code >= 0xDC00 && code < 0xE000; }

/// The character of both.
[[nodiscard]] constexpr std::uint32_t joinHalves(std::uint32_t high, std::uint32_t low) {
  return 0x10000 + ((high - 0xD800) << 10U) + (low - 0xDC00);
}

}  // namespace allpairs::scene
