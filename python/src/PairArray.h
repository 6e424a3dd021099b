// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

#include "allpairs/Pair.h"

namespace allpairs::python {

/// Pairs that Python owns: numpy.asarray makes an array of shape (m, 2), uint32, of it without a copy.
class PairArray {
 public:
  explicit PairArray(std::vector<Pair> pairs) : m_pairs(std::move(pairs)) {}

  [[nodiscard]] pybind11::buffer_info buffer();

 private:
  std::vector<Pair> m_pairs;
};

[[nodiscard]] inline std::unique_ptr<PairArray> toPython(std::vector<Pair> pairs) {
  return std::make_unique<PairArray>(std::move(pairs));
}

}  // namespace allpairs::python
