// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "allpairs/Pair.h"
#include "kernels/Lanes.h"

namespace allpairs::engine {

/// Pairs in a cache line.
inline constexpr std::size_t kLinePairs = 64 / sizeof(Pair);

/// The order of the two ids of a hit in a pair.
enum class PairSide : std::uint8_t {
  RowFirst,      ///< (row, partner): two sets, or rows in ascending order against what follows.
  RowSecond,     ///< (partner, row): rows in ascending order against what precedes.
  SmallerFirst,  ///< (min, max): one set in the order of the hierarchy.
};

/// Which columns each row is tested against.
enum class Columns : std::uint8_t {
  All,        ///< Two sets.
  Others,     ///< One set, each pair at both its indices.
  Following,  ///< One set, each pair at its smaller index.
  Preceding,  ///< One set, each pair at its larger index.
};

/// Hits of the lane test, two ids each, buffered until there are enough to convert to pairs.
///
/// Kernels flush when the next hits might not fit.
struct Hits {
  std::uint32_t* row = nullptr;
  std::uint32_t* partner = nullptr;
  std::size_t size = 0;
  std::size_t capacity = 0;  ///< Without the slack of vectors.

  /// If set, receives the positions of the hits that lanes cannot decide, because they were rounded; as large as the
  /// others.
  std::uint32_t* doubt = nullptr;
  std::size_t doubts = 0;
  LaneSlack slack;

  /// If set, hits are counted in `count` and not stored.
  bool countOnly = false;
  std::uint64_t count = 0;

  std::uint64_t boxTests = 0;
  std::uint64_t groupTests = 0;

  /// Consumes the stored hits; must set size and doubts to 0.
  void (*flush)(void* receiver, Hits& hits) = nullptr;
  void* receiver = nullptr;

  /// If set, returns where that many pairs may be written at once, which is cheaper where there are many; what is
  /// stored is taken first. `pairsBefore` others precede them, of which the first begins a cache line. takePairs() says
  /// how many there were. Pairs are of the sides that `rowSecond` says.
  Pair* (*roomForPairs)(void* receiver, Hits& hits, std::size_t most) = nullptr;
  std::size_t pairsBefore = 0;
  void (*takePairs)(void* receiver, std::size_t count) = nullptr;
  bool rowSecond = false;

  /// Makes room for `more` hits, which must not be more than the capacity.
  void require(std::size_t more) {
    if (size + more > capacity) flush(receiver, *this);
  }
};

/// Where a join puts the partners of each box of `first`, its neighbors, in ascending order: one list after the other,
/// in the order of the hierarchy.
struct NeighborLists {
  /// Which hits the exact test has to see.
  enum class Tested : std::uint8_t {
    None,
    InDoubt,  ///< Those that lanes cannot decide, because they were rounded.
    All,
  };

  Columns kept = Columns::All;  ///< Which partners, by their ids.
  Tested tested = Tested::None;
  LaneSlack slack;      ///< Of what is not in doubt, as in Hits.
  unsigned idBits = 0;  ///< Ids of partners have no more.

  std::uint32_t* partners = nullptr;
  std::size_t size = 0;
  std::size_t capacity = 0;

  std::uint64_t* begin = nullptr;   ///< By id: where its list begins, plus `base`.
  std::uint32_t* length = nullptr;  ///< By id.
  std::uint64_t base = 0;

  void* receiver = nullptr;

  bool filtered = false;  ///< A filter has to see all hits, after the exact test.

  /// Moves the partners that touch the row, if that is in doubt, and that the filter allows to the front; returns their
  /// number.
  std::size_t (*select)(NeighborLists& lists, std::uint32_t row, std::span<std::uint32_t> partners,
                        bool areDoubtful) = nullptr;

  /// Writes which of some pairs of a row and a partner do not touch; returns their number.
  std::size_t (*findApart)(NeighborLists& lists, const Pair* pairs, std::size_t size, std::uint32_t* apart) = nullptr;

  /// Provides a capacity of `more` beyond the size.
  void (*grow)(NeighborLists& lists, std::size_t more) = nullptr;

  /// Sorts numbers by their bits [begin, end), with as much memory again; returns where they are.
  std::uint64_t* (*sort)(std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned begin,
                         unsigned end) = nullptr;

  std::uint64_t exactTests = 0;

  void require(std::size_t more) {
    if (size + more > capacity) grow(*this, more);
  }
};

}  // namespace allpairs::engine
