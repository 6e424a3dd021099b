// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "BufferProtocol.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::python {

/// Pairs that Python owns: numpy.asarray makes an array of them without a copy, of shape (n, 2).
class IdPairArray {
 public:
  explicit IdPairArray(std::vector<partition::IdPair> pairs)
      : m_pairs(std::move(pairs)),
        m_table(tableOf(reinterpret_cast<std::uint64_t*>(m_pairs.data()), 2 * m_pairs.size(), 2)) {}
  IdPairArray(const IdPairArray&) = delete;
  IdPairArray& operator=(const IdPairArray&) = delete;

  [[nodiscard]] Table& table() { return m_table; }

 private:
  static_assert(std::is_standard_layout_v<partition::IdPair> && sizeof(partition::IdPair) == 2 * sizeof(std::uint64_t));

  std::vector<partition::IdPair> m_pairs;
  Table m_table;
};

[[nodiscard]] inline std::unique_ptr<IdPairArray> arrayOf(std::vector<partition::IdPair> pairs) {
  return std::make_unique<IdPairArray>(std::move(pairs));
}

}  // namespace allpairs::python
