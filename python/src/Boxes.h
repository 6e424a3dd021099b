// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "allpairs/BoxView.h"

namespace allpairs::python {

/// A set of boxes in the memory of arrays, which it keeps alive.
class Boxes {
 public:
  /// Buffers of shape (n, 3), both float32 or both float64. `label` stands before what errors say of a box.
  ///
  /// Bad input: a NaN throws InvalidBox.
  Boxes(const pybind11::buffer& lower, const pybind11::buffer& upper, std::string label);

  void setMargin(double margin) { m_set.setMargin(margin); }

  /// A contiguous buffer of n float64.
  void setMargins(const pybind11::buffer& margins);

  [[nodiscard]] const BoxView& set() const noexcept { return m_set; }

 private:
  std::vector<pybind11::buffer_info> m_held;
  BoxView m_set;
  std::string m_label;
};

}  // namespace allpairs::python
