// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/Executor.h"
#include "allpairs/Filter.h"
#include "allpairs/StopFlag.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::mpi {

using partition::IdPair;

/// The boxes of one rank: an array of Box or BoxF, a BoxView, or a callable that returns a BoxView. The view is made
/// within the search, so that a box with a NaN, which one rank has, is an error on all of them; a BoxView that was made
/// before throws where it is made.
///
/// What it is made from must outlive it, as an argument of a function does.
class LocalBoxes {
 public:
  template <class Boxes, std::enable_if_t<std::is_convertible_v<const Boxes&, BoxView>, int> = 0>
  LocalBoxes(const Boxes& boxes)  // NOLINT(google-explicit-constructor): meant to convert
      : m_view([&boxes]() -> BoxView { return boxes; }) {}
  template <class MakeView, std::enable_if_t<std::is_invocable_r_v<BoxView, const MakeView&>, bool> = true>
  LocalBoxes(const MakeView& makeView)  // NOLINT(google-explicit-constructor): meant to convert
      : m_view([&makeView]() -> BoxView { return makeView(); }) {}

  [[nodiscard]] BoxView view() const { return m_view(); }

 private:
  std::function<BoxView()> m_view;  // of one reference: without an allocation
};

/// Settings of a search on several ranks. All but `first`, `second`, `executor` and `stop` must be the same on all of
/// them.
struct DistributedOptions {
  /// As OverlapOptions::distance.
  double distance = 0.0;

  /// As OverlapOptions::region.
  std::optional<Box> region{};

  /// Groups, categories and masks of this rank's boxes, as in Filter.
  FilterBits first{};

  /// Of the second of two sets; with one set, it throws InvalidArgument.
  FilterBits second{};

  /// Runs each rank's own work; null means on the calling thread. MPI is called by the calling thread alone. Not owned.
  Executor* executor = nullptr;

  /// More pairs than this, on all ranks together, throw LimitExceeded.
  std::uint64_t maxPairs = std::numeric_limits<std::uint64_t>::max();

  /// If given, and set on any rank, a search throws Stopped on all of them. Not owned.
  const StopFlag* stop = nullptr;
};

/// Finds the overlapping pairs of boxes that lie on the ranks of an MPI communicator.
///
/// The boxes of a rank are numbered after those of the ranks before it. Each rank gets the pairs whose first box is its
/// own, ascending by (first, second): the ranks' lists one after the other are the list of one process that has all
/// boxes, whatever the number of ranks.
///
/// Geometry:  as OverlapSearch; float32 and float64 may be mixed.
/// Bad input: as onAllRanks(): what one rank throws is thrown on all, and the object can be used on. Ranks that do not
///            make the same call with the same settings, and an object that has been moved from, throw InvalidArgument.
///            A call of MPI that fails throws MpiError on the ranks that see it.
/// Cost:      each box travels once, and once more for each further cell that it reaches; boxes that reach many cells,
///            or lie where no cut divides them, are sent to all ranks, a part at a time. Beside the result a rank holds
///            4 bytes for each of its boxes and copies, one cell at a time, the pairs of one cell or part three times,
///            and half as much as the result while pairs are put in order, or as much of more than 2^32 boxes. No rank
///            holds all boxes.
/// Threads:   one search at a time per object. MPI must be initialized, with MPI_THREAD_FUNNELED where an executor is
///            given.
class DistributedOverlaps {
 public:
  /// Collective: the communicator is duplicated. The destructor is collective too.
  ///
  /// Bad input: no communicator, one between two groups, or MPI before it is initialized or after it is finalized,
  ///            throws InvalidArgument.
  explicit DistributedOverlaps(MPI_Comm communicator, const DistributedOptions& options = {});
  ~DistributedOverlaps();
  DistributedOverlaps(DistributedOverlaps&&) noexcept;
  DistributedOverlaps& operator=(DistributedOverlaps&&) noexcept;

  /// The pairs whose first box is this rank's. Collective.
  [[nodiscard]] std::vector<IdPair> find(const LocalBoxes& boxes);

  /// The pairs of a box of `first` and a box of `second`; both sets are numbered by themselves. Collective.
  [[nodiscard]] std::vector<IdPair> find(const LocalBoxes& first, const LocalBoxes& second);

  /// The number of pairs of all ranks, on each of them. Collective.
  [[nodiscard]] std::uint64_t count(const LocalBoxes& boxes);
  [[nodiscard]] std::uint64_t count(const LocalBoxes& first, const LocalBoxes& second);

 private:
  struct State;
  State& state();
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::mpi
