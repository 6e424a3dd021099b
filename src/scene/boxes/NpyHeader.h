// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace allpairs::scene {

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

/// The 128 bytes, or more for a very long shape, that NumPy itself writes before a C-ordered (rows, 2) array of uint32.
[[nodiscard]] std::string npyPairsHeader(std::uint64_t rows);

}  // namespace allpairs::scene
