// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "BufferProtocol.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"

namespace allpairs::python {

/// Pairs that Python owns: numpy.asarray makes an array of shape (m, 2), uint32, of it without a copy.
class PairArray {
 public:
  explicit PairArray(std::vector<Pair> pairs);

  /// Those that a search has found last, in its memory.
  PairArray(OverlapSearch search, std::span<const Pair> pairs);
  PairArray(const PairArray&) = delete;
  PairArray& operator=(const PairArray&) = delete;

  [[nodiscard]] Table& table() { return m_table; }

 private:
  std::vector<Pair> m_pairs;
  std::optional<OverlapSearch> m_search;
  Table m_table;
};

[[nodiscard]] inline std::unique_ptr<PairArray> toPython(std::vector<Pair> pairs) {
  return std::make_unique<PairArray>(std::move(pairs));
}

}  // namespace allpairs::python
