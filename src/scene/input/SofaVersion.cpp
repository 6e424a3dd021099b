// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "allpairs/Error.h"
#include "allpairs/scene/ReadOptions.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

/// "2406" of "24.06", "24.06.01" and "v24.06"; nothing for another form.
std::optional<int> yearAndMonth(std::string_view text) {
  if (text.starts_with('v')) text.remove_prefix(1);
  const bool hasPatch = text.size() == 8 && text[5] == '.';
  if ((text.size() != 5 && !hasPatch) || text[2] != '.') return std::nullopt;
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  for (const std::size_t part : {0U, 3U, 6U}) {
    const std::string_view digits = text.substr(std::min(part, text.size()), 2);
    if (!std::all_of(digits.begin(), digits.end(), isDigit)) return std::nullopt;
  }
  return 100 * std::stoi(std::string(text.substr(0, 2))) + std::stoi(std::string(text.substr(3, 2)));
}

/// SOFA is released in June and in December; until 2016 it was in other months too.
bool isRelease(int yearAndMonth) {
  constexpr int kFirstRegular = 1700;
  const int month = yearAndMonth % 100;
  return yearAndMonth < kFirstRegular ? month >= 1 && month <= 12 : month == 6 || month == 12;
}

}  // namespace

SofaVersion sofaVersionOf(std::string_view version) {
  constexpr int kLastOld = 2006, kFirstNew = 2206, kLastNew = 2612;
  const std::optional<int> number = yearAndMonth(version);
  if (!number || !isRelease(*number))
    throw InvalidArgument(quotedWord(version) + " is no version of SOFA, which are called YY.06 and YY.12");
  if (*number <= kLastOld) return SofaVersion::Sofa2006;
  if (*number >= kFirstNew && *number <= kLastNew) return SofaVersion::Sofa2612;
  throw InvalidArgument(quotedWord(version) + " is neither a version up to 20.06 nor one from 22.06 to 26.12");
}

}  // namespace allpairs::scene
