// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

namespace allpairs::scene {

/// A number of a binary file, which is little-endian wherever it was written; there must be as many bytes.
template <class T>
[[nodiscard]] T littleEndian(std::string_view bytes) {
  std::array<char, sizeof(T)> copy{};
  std::memcpy(copy.data(), bytes.data(), sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

}  // namespace allpairs::scene
