// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "allpairs/FunctionRef.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "input/Options.h"

namespace allpairs::engine {

/// Whether findFewBesideMany() takes these sets: a few boxes in one of them, of which only the bounds matter, and so
/// many in the other that preparing a search of any two sets would take longer than this search.
[[nodiscard]] bool areFewBesideMany(const Sets& sets, const OverlapOptions& options);

/// Calls take(pairs) with parts of the pairs, in order. Boxes are compared as they lie in the caller's memory.
///
/// Bad input: as for Search::find().
OverlapStatistics findFewBesideMany(const Sets& sets, const OverlapOptions& options, Order order,
                                    FunctionRef<void(std::span<const Pair>)> take);

}  // namespace allpairs::engine
