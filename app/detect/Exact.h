// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/collision/ExactPair.h"
#include "allpairs/scene/Scene.h"
#include "allpairs/scene/WriteResult.h"
#include "cli/Table.h"
#include "detect/Detection.h"

namespace allpairs::app {

/// What the shapes of candidates say: for each pair of a result, in its order.
struct ExactReport {
  std::vector<ExactPair> pairs{};
  double seconds = 0.0;
};

/// Throws UsageError if this program was built without the library that looks at shapes.
void requireExact();

/// Whether this program was built with that library.
[[nodiscard]] bool hasExact();

/// What a look at shapes is asked for.
struct ExactRequest {
  double clearance = 0.0;     ///< Pairs that are apart by no more are within it.
  double leastDepth = 0.0;    ///< Pairs that reach no deeper into each other touch.
  std::size_t lineLimit = 0;  ///< The maximum number of lines where surfaces cross, of each pair.
};

/// Looks at the shapes of pairs of a scene's models, given by their indices.
[[nodiscard]] ExactReport examine(const scene::Scene& scene, std::span<const Pair> candidates,
                                  const ExactRequest& request);

/// For people: the worst first, as isWorse() says.
void writeExactTable(const scene::ResultView& result, const ExactReport& report, const TableNotes& notes,
                     scene::ByteSink sink);

/// A line for each candidate, with its state, distance, depth, points, normal and number of contacts.
void writeExactCsv(const scene::ResultView& result, const ExactReport& report, scene::ByteSink sink);

/// The candidates that are not known to be apart, of which each result has the newest model first, in this order.
void writeExactNpy(const scene::ResultView& result, const ExactReport& report, BoxPairOrder order,
                   scene::ByteSink sink);

/// The object of writeJson() with two more members: "exact", a list as long as "pairs", and "exactStatistics".
void writeExactJson(const scene::ResultView& result, const ExactReport& report, scene::ByteSink sink);

}  // namespace allpairs::app
