// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "allpairs/BoxSet.h"
#include "allpairs/Filter.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// What a pair that passed the float32 test must pass still: the exact test in double, where lanes were rounded, and
/// the filter.
class PairTest {
 public:
  PairTest(const BoxSet& first, const BoxSet& second, const OverlapOptions& options, bool oneSet)
      : m_first(&first),
        m_second(&second),
        m_distance(options.distance),
        m_filter(&options.filter),
        m_secondBits(oneSet ? &options.filter.first : &options.filter.second) {
    m_filtered = hasBits(options.filter.first) || hasBits(*m_secondBits) || options.filter.accept;
  }

  /// Set once the lanes are known.
  void requireExactTest(bool required) noexcept { m_exact = required; }

  [[nodiscard]] bool needed() const noexcept { return m_exact || m_filtered; }
  [[nodiscard]] bool exactTestNeeded() const noexcept { return m_exact; }

  [[nodiscard]] bool keeps(Pair pair) const { return (!m_exact || touches(pair)) && (!m_filtered || passes(pair)); }

 private:
  static bool hasBits(const FilterBits& bits) {
    return !bits.categories.empty() || !bits.masks.empty() || !bits.groups.empty();
  }

  static std::uint32_t at(std::span<const std::uint32_t> values, std::uint32_t i, std::uint32_t otherwise) {
    return values.empty() ? otherwise : values[i];
  }

  [[nodiscard]] bool touches(Pair pair) const {
    const double d = m_distance + m_first->margin(pair.first) + m_second->margin(pair.second);
    return overlap((*m_first)[pair.first], (*m_second)[pair.second], d);
  }

  [[nodiscard]] bool passes(Pair pair) const {
    constexpr std::uint32_t kAll = 0xFFFFFFFFU;
    const FilterBits& a = m_filter->first;
    const FilterBits& b = *m_secondBits;
    if ((at(a.categories, pair.first, kAll) & at(b.masks, pair.second, kAll)) == 0) return false;
    if ((at(b.categories, pair.second, kAll) & at(a.masks, pair.first, kAll)) == 0) return false;
    const std::uint32_t group = at(a.groups, pair.first, 0);
    if (group != 0 && group == at(b.groups, pair.second, 0)) return false;
    return !m_filter->accept || m_filter->accept(pair.first, pair.second);
  }

  const BoxSet* m_first;
  const BoxSet* m_second;
  double m_distance;
  const Filter* m_filter;
  const FilterBits* m_secondBits;
  bool m_exact = false;
  bool m_filtered = false;
};

}  // namespace allpairs::engine
