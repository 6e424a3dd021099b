// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "FileBytes.h"
#include "NpyHeader.h"

namespace allpairs::scene {

/// Reads what stands before the numbers of a .npy file, format versions 1 to 3.
///
/// Bad input: anything else throws FileError.
[[nodiscard]] NpyHeader readNpyHeader(InputFile& file, const std::filesystem::path& path);

/// A shape as NumPy writes it: (3, 6).
[[nodiscard]] std::string shapeText(const std::vector<std::uint64_t>& shape);

template <class T>
void reverseBytes(T& value) {
  auto bytes = std::bit_cast<std::array<unsigned char, sizeof(T)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  value = std::bit_cast<T>(bytes);
}

/// Reads numbers of the header's type, which is T, in either byte order.
template <class T>
void readNpyNumbers(const NpyHeader& header, InputFile& file, std::span<T> values) {
  file.read(values.data(), values.size_bytes());
  const bool littleEndian = header.descr.front() != '>';
  if (littleEndian == (std::endian::native == std::endian::little)) return;
  std::for_each(values.begin(), values.end(), reverseBytes<T>);
}

}  // namespace allpairs::scene
