// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace allpairs::scene {

/// The first bytes of every .npy file.
inline constexpr std::string_view kNpyMagic = "\x93NUMPY";

/// What the header of a .npy file says about the array behind it.
struct NpyHeader {
  std::string descr;  ///< The element type as NumPy writes it: '<f4'.
  bool fortranOrder = false;
  std::vector<std::uint64_t> shape;
};

/// Parses the dictionary of a .npy header: exactly the keys descr, fortran_order and shape, each once, in any order.
///
/// Bad input: anything else throws InvalidArgument that says what.
/// Reference: NumPy's description of the format, numpy.lib.format.
[[nodiscard]] NpyHeader parseNpyHeader(std::string_view text);

/// A shape as NumPy writes it: (3, 6).
[[nodiscard]] std::string shapeText(std::span<const std::uint64_t> shape);

}  // namespace allpairs::scene
