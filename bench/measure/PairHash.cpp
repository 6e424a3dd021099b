// SPDX-License-Identifier: MIT
#include "PairHash.h"

#include <algorithm>
#include <utility>

namespace allpairs::measure {

namespace {

constexpr std::uint64_t kOffset = 14695981039346656037U;
constexpr std::uint64_t kPrime = 1099511628211U;

std::uint64_t hashOn(std::uint64_t hash, std::uint32_t value) noexcept {
  for (unsigned shift = 0; shift < 32; shift += 8) hash = (hash ^ ((value >> shift) & 0xFFU)) * kPrime;
  return hash;
}

}  // namespace

std::uint64_t hashOfPairs(std::span<const Pair> pairs) noexcept {
  std::uint64_t hash = kOffset;
  for (const Pair& pair : pairs) hash = hashOn(hashOn(hash, pair.first), pair.second);
  return hash;
}

std::vector<Pair> normalised(std::span<const Pair> pairs) {
  std::vector<Pair> result(pairs.begin(), pairs.end());
  for (Pair& pair : result) {
    if (pair.first > pair.second) std::swap(pair.first, pair.second);
  }
  if (!std::is_sorted(result.begin(), result.end())) std::sort(result.begin(), result.end());
  return result;
}

std::string hexadecimal(std::uint64_t hash) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < text.size(); ++i) text[text.size() - 1 - i] = kDigits[(hash >> (4 * i)) & 0xFU];
  return text;
}

}  // namespace allpairs::measure
