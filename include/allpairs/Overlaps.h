// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/Neighbors.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "allpairs/Span.h"

namespace allpairs {

/// Statistics of the last search.
struct OverlapStatistics {
  std::uint64_t pairs = 0;       ///< The number of pairs in the result; each is counted once, in rows of neighbors too.
  std::uint64_t boxTests = 0;    ///< Tests of two boxes, each in one lane of a vector.
  std::uint64_t groupTests = 0;  ///< Tests of the bounds of two groups, or of a box and a group.
  std::uint64_t exactTests = 0;  ///< Candidates that float32 could not decide, and that were tested in double; not
                                 ///< counted where few boxes are compared one by one or as they lie in memory, and
                                 ///< none where bounds take so few values that each has a float32 of its own.
};

/// Receives pairs in batches; the span is valid during the call only.
using PairVisitor = FunctionRef<void(Span<const Pair>)>;

/// The default maximum number of pairs in a batch.
inline constexpr std::size_t kBatchSize = 65536;

/// Finds overlapping boxes, and keeps its working memory between searches.
///
/// Geometry:  boxes are closed: sharing a face, an edge or a corner is an overlap. Empty boxes overlap nothing.
/// Bad input: invalid options, such as an unknown instruction set, throw InvalidArgument.
/// Cost:      up to 70 bytes per box and 8 per pair, up to 25 while their buffer grows, both twice with a parallel
///            executor, and some 100 KB for each thread: what is asked of the memory, of which a part is seldom used. On
///            the calling thread a second search of the same size allocates nothing. Of the default memory an ordered
///            search of up to a million boxes reserves 64 bytes per box more, and seldom uses them.
/// Threads:   one search at a time per object; parallel inside if the options have an executor.
/// Memory:    after a search that threw, whether std::bad_alloc or an exception of a filter or visitor, the next search
///            behaves like that of a new object; the previous result is lost.
/// Callbacks: a filter, visitor or task may search with other objects and with the free functions. On the object that
///            calls it, all members except options() and statistics() throw InvalidArgument; it must not move or
///            destroy it.
/// Moving:    a moved-from object is like a new one with default options.
///
/// What the options refer to (the filter's spans, the executor, the name of the instruction set) must outlive their
/// use.
class OverlapSearch {
 public:
  explicit OverlapSearch(OverlapOptions options = {});
  ~OverlapSearch();
  OverlapSearch(OverlapSearch&&) noexcept;
  OverlapSearch& operator=(OverlapSearch&&) noexcept;

  [[nodiscard]] const OverlapOptions& options() const noexcept;

  /// Bad input: a memory resource other than that of construction throws InvalidArgument; null keeps it.
  void setOptions(OverlapOptions options);

  /// All overlapping pairs of one set, each once. Valid until the next search or the object's destruction.
  [[nodiscard]] Span<const Pair> find(const BoxView& boxes);

  /// All pairs of a box of `first` and a box of `second` that overlap.
  ///
  /// Bad input: options for two sets, filter.second, throw InvalidArgument with one set.
  [[nodiscard]] Span<const Pair> find(const BoxView& first, const BoxView& second);

  /// The pairs of find() as rows of partners: see neighbors(). Valid until the next search or the object's destruction.
  [[nodiscard]] NeighborsView findNeighbors(const BoxView& boxes, NeighborRows rows = NeighborRows::Full);
  [[nodiscard]] NeighborsView findNeighbors(const BoxView& first, const BoxView& second);

  /// Writes the pairs of find() to memory of the caller, and returns the part of it that they take. Count them first.
  ///
  /// Bad input: memory for fewer pairs than there are throws LimitExceeded, whose count() is their number. Some of
  ///            them may have been written.
  /// Cost:      no second copy of the result, unless several threads find unordered pairs or test exhaustively.
  Span<Pair> findInto(const BoxView& boxes, Span<Pair> memory);
  Span<Pair> findInto(const BoxView& first, const BoxView& second, Span<Pair> memory);

  /// Writes the rows of findNeighbors() to memory of the caller, and returns the part of it that they take.
  ///
  /// Bad input: memory for too few offsets throws InvalidArgument; for fewer indices than there are, LimitExceeded,
  ///            whose count() is their number. The memory is then as it was.
  NeighborsView findNeighborsInto(const BoxView& boxes, NeighborRows rows, const NeighborsMemory& memory);
  NeighborsView findNeighborsInto(const BoxView& first, const BoxView& second, const NeighborsMemory& memory);

  /// The number of pairs of find(); uses memory independent of that number.
  [[nodiscard]] std::uint64_t count(const BoxView& boxes);
  [[nodiscard]] std::uint64_t count(const BoxView& first, const BoxView& second);

  /// Passes the pairs of find() to the visitor, in batches of at most `batchSize`; uses memory independent of their
  /// number. The visitor is called on the calling thread; an exception from it ends the search.
  ///
  /// Bad input: a batch size of 0 throws InvalidArgument; more than options().maxPairs pairs throw LimitExceeded,
  ///            after the visitor has received at most maxPairs.
  void stream(const BoxView& boxes, PairVisitor visitor, std::size_t batchSize = kBatchSize);
  void stream(const BoxView& first, const BoxView& second, PairVisitor visitor, std::size_t batchSize = kBatchSize);

  /// Releases the memory kept for the next search. The last result stays valid.
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
/// Bad input: BoxView rejects a box with a NaN; min > max on an axis means empty.
/// Cost:      O(n log n + pairs) for boxes of bounded density, n(n-1)/2 vectorised tests at worst; see OverlapSearch.
/// Threads:   const on the set; parallel if the options have an executor.
[[nodiscard]] std::vector<Pair> overlaps(const BoxView& boxes, const OverlapOptions& options = {});

/// All overlapping pairs of a box of `first` and a box of `second`, ordered by (first, second).
[[nodiscard]] std::vector<Pair> overlaps(const BoxView& first, const BoxView& second,
                                         const OverlapOptions& options = {});

/// The number of pairs of overlaps(), without storing them.
[[nodiscard]] std::uint64_t countOverlaps(const BoxView& boxes, const OverlapOptions& options = {});
[[nodiscard]] std::uint64_t countOverlaps(const BoxView& first, const BoxView& second,
                                          const OverlapOptions& options = {});

/// Passes the pairs of overlaps() to a visitor in batches, in bounded memory; see OverlapSearch::stream().
void streamOverlaps(const BoxView& boxes, PairVisitor visitor, const OverlapOptions& options = {},
                    std::size_t batchSize = kBatchSize);
void streamOverlaps(const BoxView& first, const BoxView& second, PairVisitor visitor,
                    const OverlapOptions& options = {}, std::size_t batchSize = kBatchSize);

/// The instruction sets that both this processor and this build support, best first; "SCALAR" is always the last.
[[nodiscard]] Span<const std::string_view> instructionSets();

}  // namespace allpairs
