// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Pair.h"

namespace allpairs::test {

/// How npyBytes() writes an array: everything that a reader must cope with.
struct NpyStyle {
  std::string descr = "<f8";
  bool fortran = false;
  int version = 1;
  std::string shape{};  ///< Empty: what fits.
};

inline std::string npyHeaderBytes(const std::string& dictionary, int version = 1) {
  std::string header = dictionary;
  header.append(63 - (header.size() + (version == 1 ? 10 : 12)) % 64, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  for (unsigned shift = 0; shift < (version == 1 ? 16U : 32U); shift += 8) {
    bytes += static_cast<char>(header.size() >> shift & 0xff);
  }
  return bytes + header;
}

template <class T>
void appendNumber(std::string& bytes, T value, bool bigEndian) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));  // tests run on little-endian machines
  bytes += bigEndian ? std::string(raw.rbegin(), raw.rend()) : std::string(raw.begin(), raw.end());
}

/// Boxes as the bytes of a .npy file.
inline std::string npyBytes(const std::vector<Box>& boxes, const NpyStyle& style = {}) {
  const std::string shape = style.shape.empty() ? '(' + std::to_string(boxes.size()) + ", 6)" : style.shape;
  std::string bytes =
      npyHeaderBytes("{'descr': '" + style.descr + "', 'fortran_order': " + (style.fortran ? "True" : "False") +
                         ", 'shape': " + shape + ", }",
                     style.version);
  for (std::size_t k = 0; k < boxes.size() * 6; ++k) {
    const std::size_t row = style.fortran ? k % boxes.size() : k / 6;
    const std::size_t column = style.fortran ? k / boxes.size() : k % 6;
    const double value = column < 3 ? boxes[row].min[column] : boxes[row].max[column - 3];
    const bool big = style.descr[0] == '>';
    if (style.descr.back() == '4') appendNumber(bytes, static_cast<float>(value), big);
    if (style.descr.back() == '8') appendNumber(bytes, value, big);
  }
  return bytes;
}

/// Numbers as the bytes of a .npy file of shape (n,); `descr` is their type.
template <class T>
std::string npyNumbers(const std::vector<T>& numbers, const std::string& descr) {
  std::string bytes = npyHeaderBytes("{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" +
                                     std::to_string(numbers.size()) + ",), }");
  for (const T number : numbers) appendNumber(bytes, number, descr[0] == '>');
  return bytes;
}

/// The pairs in a .npy file of shape (m, 2) and type uint32, its 128 bytes of header taken on trust.
inline std::vector<Pair> pairsOfNpy(const std::string& bytes) {
  constexpr std::size_t kHeader = 128;
  std::vector<Pair> pairs(bytes.size() < kHeader ? 0 : (bytes.size() - kHeader) / sizeof(Pair));
  if (!pairs.empty()) std::memcpy(pairs.data(), bytes.data() + kHeader, pairs.size() * sizeof(Pair));
  return pairs;
}

}  // namespace allpairs::test
