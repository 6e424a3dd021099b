// SPDX-License-Identifier: MIT
#include "PairArray.h"

#include <cstddef>
#include <cstdint>

namespace allpairs::python {
namespace py = pybind11;

static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t) && offsetof(Pair, second) == sizeof(std::uint32_t));

py::buffer_info PairArray::buffer() {
  constexpr py::ssize_t kSize = sizeof(std::uint32_t);
  const auto rows = static_cast<py::ssize_t>(m_pairs.size());
  return {m_pairs.data(),    kSize, py::format_descriptor<std::uint32_t>::format(), 2, {rows, py::ssize_t{2}},
          {2 * kSize, kSize}};
}

}  // namespace allpairs::python
