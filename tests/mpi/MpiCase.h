// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "DistributedSearch.h"
#include "Ranks.h"
#include "Tuning.h"
#include "allpairs/mpi/DistributedOverlaps.h"
#include "support/Oracle.h"

namespace allpairs::test {

using mpi::IdPair;

inline int rankHere() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int rankCount() {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

/// So little that everything is cut, and travels in pieces.
inline mpi::Tuning tinyTuning() {
  return {
      .boxesPerCell = 40, .samplePerCell = 4, .leastSample = 50, .leastCrowded = 20, .wideAtOnce = 7, .pieceWords = 5};
}

/// How boxes are dealt out to the ranks: where each rank's begin, and the end.
inline std::vector<std::size_t> evenly(std::size_t boxes) {
  std::vector<std::size_t> begins;
  const auto ranks = static_cast<std::size_t>(rankCount());
  for (std::size_t rank = 0; rank <= ranks; ++rank) begins.push_back(boxes * rank / ranks);
  return begins;
}

/// Some ranks get none, now and then all but one.
inline std::vector<std::size_t> atRandom(std::size_t boxes, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<std::size_t> begins{0};
  for (int rank = 1; rank < rankCount(); ++rank) begins.push_back(generator() % 3 == 0 ? 0 : generator() % (boxes + 1));
  std::sort(begins.begin(), begins.end());
  begins.push_back(boxes);
  return begins;
}

template <class Value>
std::span<const Value> hereOf(const std::vector<Value>& all, const std::vector<std::size_t>& begins) {
  const auto rank = static_cast<std::size_t>(rankHere());
  return all.empty() ? std::span<const Value>() : std::span(all).subspan(begins[rank], begins[rank + 1] - begins[rank]);
}

/// Those of all pairs whose first box is this rank's.
inline std::vector<IdPair> pairsHere(const std::vector<Pair>& all, const std::vector<std::size_t>& begins) {
  const auto rank = static_cast<std::size_t>(rankHere());
  std::vector<IdPair> pairs;
  for (const Pair pair : all) {
    if (pair.first >= begins[rank] && pair.first < begins[rank + 1]) pairs.push_back({pair.first, pair.second});
  }
  return pairs;
}

/// Searches as DistributedOverlaps does, cut as tuning says.
class MpiSearch {
 public:
  explicit MpiSearch(mpi::DistributedOptions options = {}, const mpi::Tuning& tuning = tinyTuning())
      : m_tuning(tuning), m_ranks(MPI_COMM_WORLD, tuning.pieceWords), m_options(options) {}

  std::vector<IdPair> find(const std::vector<mpi::LocalBoxes>& sets) {
    return mpi::DistributedSearch(m_ranks, m_options, m_tuning).find(sets);
  }
  std::uint64_t count(const std::vector<mpi::LocalBoxes>& sets) {
    return mpi::DistributedSearch(m_ranks, m_options, m_tuning).count(sets);
  }

 private:
  mpi::Tuning m_tuning;
  mpi::Ranks m_ranks;
  mpi::DistributedOptions m_options;
};

}  // namespace allpairs::test
