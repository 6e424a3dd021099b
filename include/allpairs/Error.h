// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "allpairs/DebugMode.h"

namespace allpairs {

/// A text with control characters as \xNN, byte by byte: those of ASCII, and those of C1 in UTF-8, which terminals obey
/// too.
[[nodiscard]] inline std::string escapedControls(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto isC1 = [text](std::size_t at) {
    if (at + 1 >= text.size() || text[at] != '\xc2') return false;
    const auto next = static_cast<unsigned char>(text[at + 1]);
    return next >= 0x80 && next < 0xa0;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool isControl = byte < 0x20 || byte == 0x7f || isC1(i) || (i > 0 && isC1(i - 1));
    result += isControl ? std::string("\\x") + kDigits[byte >> 4] + kDigits[byte & 15] : std::string(1, text[i]);
  }
  return result;
}

/// 1234567 as "1,234,567".
[[nodiscard]] inline std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t position = digits.size(); position > 3;) {
    position -= 3;
    digits.insert(position, 1, ',');
  }
  return digits;
}

/// A text as messages show it: one line of at most 500 bytes, control characters escaped as \xNN, a longer text
/// shortened in the middle. It may contain names and text from untrusted files.
[[nodiscard]] inline std::string oneLine(std::string_view text) {
  constexpr std::size_t kMost = 500;
  constexpr std::size_t kHalf = kMost / 2 - 2;  // beside the three dots
  constexpr std::size_t kRelevant = 4 * kMost;  // text further inside is cut anyway
  const bool isLong = text.size() > 2 * kRelevant;
  std::string line = escapedControls(isLong ? text.substr(0, kRelevant) : text) +
                     (isLong ? escapedControls(text.substr(text.size() - kRelevant)) : std::string());
  if (line.size() <= kMost) return line;
  const auto isInside = [&line](std::size_t at) { return (static_cast<unsigned char>(line[at]) & 0xc0) == 0x80; };
  std::size_t left = kHalf;
  std::size_t right = line.size() - kHalf;
  while (left > 0 && isInside(left)) --left;  // do not split a character
  while (right < line.size() && isInside(right)) ++right;
  return line.substr(0, left) + "..." + line.substr(right);
}

/// Base of all exceptions of Allpairs: bad data, bad settings, bad files.
///
/// The library never prints, aborts or truncates a result; it throws one of these, whose `what()` is one line that
/// names the box, model, option, or file and position at fault.
class Error : public std::runtime_error {
 public:
  explicit Error(std::string_view message) : std::runtime_error(oneLine(message)) {}
};

/// An invalid setting or argument: a span of the wrong length, a NaN distance, a reversed region.
class InvalidArgument : public Error {
 public:
  using Error::Error;
};

/// An invalid box or per-box value; `index()` is its index.
class InvalidBox : public Error {
 public:
  InvalidBox(std::size_t index, const std::string& message) : Error(message), m_index(index) {}

  /// Of a box that has no name but its index: "box 3: min z is not a number (NaN)".
  [[nodiscard]] static InvalidBox ofSet(std::size_t index, const std::string& problem) {
    InvalidBox result(index, describe(index, problem));
    result.m_problem = problem;
    return result;
  }

  [[nodiscard]] std::size_t index() const noexcept { return m_index; }

  /// The message where the box has another number, as in a file whose boxes the set is a part of.
  [[nodiscard]] std::string messageOf(std::uint64_t number) const {
    return m_problem.empty() ? what() : describe(number, m_problem);
  }

 private:
  static std::string describe(std::uint64_t number, const std::string& problem) {
    return "box " + std::to_string(number) + ": " + problem;
  }

  std::size_t m_index;
  std::string m_problem{};  ///< Without the box; empty where that has a name.
};

/// More pairs than the caller allowed, or has memory for.
class LimitExceeded : public Error {
 public:
  LimitExceeded(std::uint64_t count, const std::string& message, bool isTotal = false)
      : Error(message), m_count(count), m_isTotal(isTotal) {}

  /// How many had been found; of memory for rows, the number of their indices.
  [[nodiscard]] std::uint64_t count() const noexcept { return m_count; }

  /// Whether these are all that there are: only the memory was too small. A limit ends the search.
  [[nodiscard]] bool isTotal() const noexcept { return m_isTotal; }

 private:
  std::uint64_t m_count;
  bool m_isTotal;
};

/// A search that its options' `stop` has ended before it was complete.
class Stopped : public Error {
 public:
  Stopped() : Error("the search was stopped before its end") {}
};

}  // namespace allpairs
