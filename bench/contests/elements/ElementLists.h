// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/elements/ElementCandidates.h"

namespace allpairs::bench {

/// A mesh at the start and at the end of a step, and the boxes of its elements as peers take them.
struct ElementStep {
  std::vector<double> start;
  std::vector<double> end;
  std::vector<std::uint32_t> triangles;
};

[[nodiscard]] ElementStep readStep(const std::string& start, const std::string& end);

/// The boxes of vertices, edges or faces as rows of 6 floats, each bound rounded outward.
[[nodiscard]] std::vector<float> vertexRows(const ElementStep& step);
[[nodiscard]] std::vector<float> edgeRows(const ElementStep& step, const elements::MeshTopology& topology);
[[nodiscard]] std::vector<float> faceRows(const ElementStep& step, const elements::MeshTopology& topology);

/// The pairs of a peer that have no vertex in common: what each peer has to do too.
[[nodiscard]] std::vector<Pair> withoutShared(std::span<const Pair> pairs, elements::CandidateKind kind,
                                              const elements::MeshTopology& topology);

/// Those of the pairs whose boxes overlap in double, in ascending order, the smaller of two elements of a kind first: of
/// a peer's pairs, whose boxes are rounded, what ours has to be.
[[nodiscard]] std::vector<Pair> overlapping(std::span<const Pair> pairs, elements::CandidateKind kind,
                                            const ElementStep& step, const elements::MeshTopology& topology);

/// CGAL's search between two sets of rows, with a cutoff.
[[nodiscard]] std::vector<Pair> cgalBetween(std::span<const float> first, std::span<const float> second,
                                            std::ptrdiff_t cutoff);

}  // namespace allpairs::bench
