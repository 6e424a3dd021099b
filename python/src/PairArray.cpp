// SPDX-License-Identifier: MIT
#include "PairArray.h"

#include <cstddef>
#include <cstdint>

namespace allpairs::python {

static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t) && offsetof(Pair, second) == sizeof(std::uint32_t));

namespace {

Table pairTable(Pair* pairs, std::size_t size) { return tableOf(reinterpret_cast<std::uint32_t*>(pairs), 2 * size, 2); }

}  // namespace

PairArray::PairArray(std::vector<Pair> pairs)
    : m_pairs(std::move(pairs)), m_table(pairTable(m_pairs.data(), m_pairs.size())) {}

PairArray::PairArray(OverlapSearch search, std::span<const Pair> pairs)
    : m_search(std::move(search)), m_table(pairTable(const_cast<Pair*>(pairs.data()), pairs.size())) {}

}  // namespace allpairs::python
