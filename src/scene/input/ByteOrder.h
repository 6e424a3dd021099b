// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

namespace allpairs::scene {

/// The number that a binary file's next bytes are, in its byte order; there must be as many.
template <class T>
[[nodiscard]] T numberOf(std::string_view bytes, std::endian order) {
  std::array<char, sizeof(T)> copy{};
  std::memcpy(copy.data(), bytes.data(), sizeof(T));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

template <class T>
[[nodiscard]] T littleEndian(std::string_view bytes) {
  return numberOf<T>(bytes, std::endian::little);
}

}  // namespace allpairs::scene
