// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/fcl/FclNarrowPhase.h"
#include "allpairs/scene/Scene.h"
#include "allpairs/scene/WriteResult.h"
#include "cli/Table.h"

namespace allpairs::app {

/// What the shapes of candidates say: for each pair of a result, in its order.
struct ExactReport {
  std::vector<ExactPair> pairs{};
  double seconds = 0.0;
};

/// How many pairs came out how.
struct ExactCounts {
  std::uint64_t apart = 0;
  std::uint64_t touching = 0;
  std::uint64_t overlapping = 0;
  std::uint64_t contained = 0;
  std::uint64_t notExamined = 0;

  [[nodiscard]] std::uint64_t inContact() const { return touching + overlapping + contained; }

  /// The part of the examined pairs that only their boxes had in common; 0 where none was examined.
  [[nodiscard]] double falseShare() const;
};

[[nodiscard]] ExactCounts countStates(std::span<const ExactPair> pairs);

/// The word that results use for a state: apart, touching, overlapping, contained, not-examined.
[[nodiscard]] const char* stateName(ExactState state);

/// Throws UsageError if this program was built without the library that looks at shapes.
void requireExact();

/// Looks at the shapes of pairs of a scene's models, given by their indices.
[[nodiscard]] ExactReport examine(const scene::Scene& scene, std::span<const Pair> candidates);

/// The candidates that are not known to be apart.
[[nodiscard]] std::vector<Pair> withoutFalse(std::span<const Pair> candidates, const ExactReport& report);

/// For people: the deepest contacts first, then the nearest of the others.
void writeExactTable(const scene::ResultView& result, const ExactReport& report, const TableNotes& notes,
                     scene::ByteSink sink);

/// A line for each candidate, with its state, distance, depth, points, normal and number of contacts.
void writeExactCsv(const scene::ResultView& result, const ExactReport& report, scene::ByteSink sink);

/// The object of writeJson() with two more members: "exact", a list as long as "pairs", and "exactStatistics".
void writeExactJson(const scene::ResultView& result, const ExactReport& report, scene::ByteSink sink);

}  // namespace allpairs::app
