// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "allpairs/FunctionRef.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "input/Options.h"

namespace allpairs::engine {

/// How many pairs of boxes there are.
[[nodiscard]] std::size_t pairsOf(const Sets& sets) noexcept;

/// Whether findFew() takes these sets: at most kMostFew boxes each that are not to be searched
/// by a hierarchy; or up to kMostOthers beside any number. An unknown instruction set is refused by findFew().
[[nodiscard]] bool areFew(const Sets& sets, const OverlapOptions& options);

/// Calls take(pairs) with the pairs of a few boxes, in an order that may be another than that of the options, and in
/// parts; an unordered search gives them by first box. Uses up to 90 KB of stack and no other memory: with so few
/// boxes, preparing a search would take longer than the search.
///
/// Bad input: as for Search::find().
OverlapStatistics findFew(const Sets& sets, const OverlapOptions& options, Order order,
                          FunctionRef<void(std::span<const Pair>)> take);

/// Only counts them.
OverlapStatistics countFew(const Sets& sets, const OverlapOptions& options);

// What these use.

/// Whether findFewBesideMany() takes these sets: a few boxes in one of them, of which only the bounds matter, and so
/// many in the other that preparing a search of any two sets would take longer than this search.
[[nodiscard]] bool areFewBesideMany(const Sets& sets, const OverlapOptions& options);

/// Calls take(pairs) with parts of the pairs, in order. Boxes are compared as they lie in the caller's memory.
///
/// Bad input: as for Search::find().
OverlapStatistics findFewBesideMany(const Sets& sets, const OverlapOptions& options, Order order,
                                    FunctionRef<void(std::span<const Pair>)> take);

/// Room for pairs on the stack. Pairs themselves would be set to 0 first, which takes longer than many a search.
template <std::size_t kSize>
class PairsOnStack {
 public:
  [[nodiscard]] Pair* data() noexcept { return reinterpret_cast<Pair*>(m_bytes.data()); }

 private:
  alignas(64) std::array<std::byte, kSize * sizeof(Pair)> m_bytes;
};

}  // namespace allpairs::engine
