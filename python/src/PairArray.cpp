// SPDX-License-Identifier: MIT
#include "PairArray.h"

#include <cstddef>
#include <cstdint>

namespace allpairs::python {

static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t) && offsetof(Pair, second) == sizeof(std::uint32_t));

PairArray::PairArray(std::vector<Pair> pairs) : m_pairs(std::move(pairs)) {
  m_table = tableOf(reinterpret_cast<std::uint32_t*>(m_pairs.data()), 2 * m_pairs.size(), 2);
}

}  // namespace allpairs::python
