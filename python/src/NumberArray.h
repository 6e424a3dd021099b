// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

namespace allpairs::python {

/// Numbers that Python owns: numpy.asarray makes an array of them without a copy, of shape (n,), or (n, columns).
template <class T>
class NumberArray {
 public:
  explicit NumberArray(std::vector<T> values, pybind11::ssize_t columns = 0)
      : m_values(std::move(values)), m_columns(columns) {}

  [[nodiscard]] pybind11::buffer_info buffer() {
    constexpr pybind11::ssize_t kSize = sizeof(T);
    const auto size = static_cast<pybind11::ssize_t>(m_values.size());
    const std::string format = pybind11::format_descriptor<T>::format();
    if (m_columns == 0) return {m_values.data(), kSize, format, 1, {size}, {kSize}};
    return {m_values.data(), kSize, format, 2, {size / m_columns, m_columns}, {m_columns * kSize, kSize}};
  }

 private:
  std::vector<T> m_values;
  pybind11::ssize_t m_columns;
};

}  // namespace allpairs::python
