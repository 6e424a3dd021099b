// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "BufferProtocol.h"

namespace allpairs::python {

/// Numbers that Python owns: numpy.asarray makes an array of them without a copy, of shape (n,), or (n, columns).
template <class T>
class NumberArray {
 public:
  explicit NumberArray(std::vector<T> values, pybind11::ssize_t columns = 0)
      : m_values(std::move(values)), m_table(tableOf(m_values.data(), m_values.size(), columns)) {}
  NumberArray(const NumberArray&) = delete;
  NumberArray& operator=(const NumberArray&) = delete;

  [[nodiscard]] Table& table() { return m_table; }
  [[nodiscard]] std::span<T> values() { return m_values; }

 private:
  std::vector<T> m_values;
  Table m_table;
};

using IdArray = NumberArray<std::uint32_t>;
using OffsetArray = NumberArray<std::uint64_t>;
using RealArray = NumberArray<double>;

template <class T>
[[nodiscard]] std::unique_ptr<NumberArray<T>> arrayOf(std::vector<T> values, pybind11::ssize_t columns = 0) {
  return std::make_unique<NumberArray<T>>(std::move(values), columns);
}

}  // namespace allpairs::python
