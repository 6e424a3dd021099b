// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"

namespace allpairs {

/// What the last search did.
struct OverlapStatistics {
  std::uint64_t pairs = 0;       ///< How many pairs it gave.
  std::uint64_t boxTests = 0;    ///< Pairs of boxes that were tested, each by one lane of a vector.
  std::uint64_t groupTests = 0;  ///< Pairs of groups, or of a box and a group, that were tested by their bounds.
  std::uint64_t exactTests = 0;  ///< Survivors of the float32 test that were tested again in double.
};

/// Takes pairs, a batch at a time; the span is valid during the call only.
using PairVisitor = FunctionRef<void(std::span<const Pair>)>;

/// How many pairs a visitor is handed at a time, at most, unless it is said.
inline constexpr std::size_t kBatchSize = 65536;

/// Finds overlapping boxes, and keeps its working memory from one search to the next.
///
/// Geometry:  boxes are closed: sharing a face, an edge or a corner is an overlap. Empty boxes overlap nothing.
/// Bad input: options that make no sense throw InvalidArgument; an unknown instruction set too.
/// Cost:      up to 48 bytes a box, and the pairs: 8 bytes each, in a buffer that grows by doubling; twice with a parallel
///            executor. On the calling thread a second search of the same size allocates nothing.
/// Threads:   one search at a time per object; parallel inside when the options name an executor.
/// Memory:    after a search that threw, std::bad_alloc or what a filter or visitor throws included, the next one gives
///            what a new object gives; the result before it is lost.
/// Callbacks: a filter, visitor or task may search with other objects and by the free functions; of the object that calls
///            it, all but options() and statistics() throw InvalidArgument, and it must not be moved or destroyed.
/// Moving:    an object that has been moved from is as a new one with default options.
///
/// What options refer to, the filter's spans, the executor and the name of the instruction set, must outlive their use.
class OverlapSearch {
 public:
  explicit OverlapSearch(OverlapOptions options = {});
  ~OverlapSearch();
  OverlapSearch(OverlapSearch&&) noexcept;
  OverlapSearch& operator=(OverlapSearch&&) noexcept;

  [[nodiscard]] const OverlapOptions& options() const noexcept;

  /// Bad input: memory other than what the object was made with throws InvalidArgument; null keeps that.
  void setOptions(OverlapOptions options);

  /// All overlapping pairs of one set, each once. The result is valid until the next search or the end of the object.
  [[nodiscard]] std::span<const Pair> find(const BoxView& boxes);

  /// All pairs of a box of `first` and a box of `second` that overlap.
  ///
  /// Bad input: options that are about the other kind of search, filter.second with one set, throw InvalidArgument.
  [[nodiscard]] std::span<const Pair> find(const BoxView& first, const BoxView& second);

  /// How many pairs find() would give, in memory that does not depend on it.
  [[nodiscard]] std::uint64_t count(const BoxView& boxes);
  [[nodiscard]] std::uint64_t count(const BoxView& first, const BoxView& second);

  /// Hands the pairs of find() to the visitor, in batches of at most `batchSize`, in memory that does not depend on their
  /// number. The visitor is called from the calling thread; what it throws ends the search.
  ///
  /// Bad input: a batch size of 0 throws InvalidArgument; with more than options().maxPairs pairs, LimitExceeded is thrown
  ///            after the visitor has had at most so many.
  void stream(const BoxView& boxes, PairVisitor visitor, std::size_t batchSize = kBatchSize);
  void stream(const BoxView& first, const BoxView& second, PairVisitor visitor, std::size_t batchSize = kBatchSize);

  /// Gives back the memory that is kept for the next search. The result of the last one stays valid.
  void shrink();

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept;

 private:
  struct State;
  State& state();
  State* m_state = nullptr;  ///< Owned; null in an object that has been moved from.
};

/// All overlapping pairs among the boxes of one set, each once, ordered by (first, second).
///
/// Geometry:  boxes are closed: sharing a face, an edge or a corner is an overlap.
/// Bad input: a box with a NaN never gets here (BoxView rejects it); min > max on an axis means empty.
/// Cost:      O(n log n + pairs) for boxes of bounded density, n(n-1)/2 vectorised tests at worst; see OverlapSearch.
/// Threads:   const on the set; parallel when the options name an executor.
[[nodiscard]] std::vector<Pair> overlaps(const BoxView& boxes, const OverlapOptions& options = {});

/// All overlapping pairs of a box of `first` and a box of `second`, ordered by (first, second).
[[nodiscard]] std::vector<Pair> overlaps(const BoxView& first, const BoxView& second,
                                         const OverlapOptions& options = {});

/// How many pairs overlaps() would give; needs no memory for them.
[[nodiscard]] std::uint64_t countOverlaps(const BoxView& boxes, const OverlapOptions& options = {});
[[nodiscard]] std::uint64_t countOverlaps(const BoxView& first, const BoxView& second,
                                          const OverlapOptions& options = {});

/// Hands the pairs of overlaps() to a visitor in batches, in bounded memory; see OverlapSearch::stream().
void streamOverlaps(const BoxView& boxes, PairVisitor visitor, const OverlapOptions& options = {},
                    std::size_t batchSize = kBatchSize);
void streamOverlaps(const BoxView& first, const BoxView& second, PairVisitor visitor,
                    const OverlapOptions& options = {}, std::size_t batchSize = kBatchSize);

/// The instruction sets that this processor has and this build carries, best first; "SCALAR" is always the last.
[[nodiscard]] std::span<const std::string_view> instructionSets();

}  // namespace allpairs
