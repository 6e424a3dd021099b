// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "allpairs/BoxView.h"

namespace allpairs::python {

/// What of a buffer is asked for: the package has made sure of it, and a direct caller of _core gets an error.
struct BufferShape {
  std::string format;         ///< As PEP 3118 has it: f, d, I.
  pybind11::ssize_t columns;  ///< 0 for one dimension.
};

/// The buffer's memory, held for as long as the result lives.
///
/// Bad input: another format or shape, or strides that are no whole number of elements, throw InvalidArgument.
[[nodiscard]] pybind11::buffer_info requestBuffer(const pybind11::buffer& buffer, const BufferShape& shape);

/// Whether the buffer's numbers are float32; otherwise they should be float64.
[[nodiscard]] bool isFloat32(const pybind11::buffer& buffer);

/// The corners that a buffer of shape (n, 3) holds.
template <class T>
[[nodiscard]] CornerView<T> cornersOf(const pybind11::buffer_info& info) {
  const auto size = static_cast<pybind11::ssize_t>(sizeof(T));
  return {static_cast<const T*>(info.ptr), info.strides[0] / size, info.strides[1] / size};
}

/// The values of a contiguous buffer, over all its dimensions.
template <class T>
[[nodiscard]] std::span<const T> valuesOf(const pybind11::buffer_info& info) {
  return {static_cast<const T*>(info.ptr), static_cast<std::size_t>(info.size)};
}

}  // namespace allpairs::python
