// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "allpairs/FunctionRef.h"
#include "allpairs/Pair.h"
#include "allpairs/Worlds.h"
#include "kernels/Lanes.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// The most boxes of a world that the kernels for worlds take: no fewer than any instruction set tests exhaustively,
/// and the boxes and the hits of 64 of them, of one set, fit the first-level cache (worlds_benchmark).
inline constexpr std::size_t kMostInWorld = 448;

/// Boxes whose hits make a word of bits.
inline constexpr std::size_t kWordBoxes = 64;

static_assert(kMostInWorld % kWordBoxes == 0);

/// The places of a world's boxes among lanes and bits: its last box has the last place of a word, so that the boxes
/// that follow a box are in as few vectors as possible.
struct WorldPlaces {
  std::size_t first;  ///< The place of box 0.
  std::size_t words;

  static WorldPlaces of(std::size_t boxes) noexcept {
    const std::size_t words = (boxes + kWordBoxes - 1) / kWordBoxes;
    return {words * kWordBoxes - boxes, words};
  }

  [[nodiscard]] std::size_t end() const noexcept { return words * kWordBoxes; }
  [[nodiscard]] std::size_t boxes() const noexcept { return end() - first; }

  /// Where the word of a place ends.
  [[nodiscard]] static std::size_t endOfWord(std::size_t place) noexcept {
    return (place / kWordBoxes + 1) * kWordBoxes;
  }

  /// How many pairs there can be of the boxes from one of `begin` up to the end of its word, each with those that
  /// follow, or precede it.
  [[nodiscard]] std::size_t pairsFrom(std::size_t begin, bool preceding) const noexcept {
    const std::size_t rows = endOfWord(begin) - begin;
    const std::size_t columns = preceding ? endOfWord(begin) - first : end() - begin;
    return rows * columns - rows * (rows + 1) / 2;
  }
};

/// The boxes of a world, a row for each bound, by place.
template <class T>
using WorldTile = std::array<std::array<T, kMostInWorld>, 6>;

/// What becomes of the hits of worlds: which of them are pairs, and where these go, one world's after the other's.
struct WorldSink {
  /// All pairs of so many boxes.
  [[nodiscard]] static constexpr std::size_t pairsOf(std::size_t boxes) noexcept {
    return boxes * (boxes - (boxes == 0 ? 0 : 1)) / 2;
  }

  /// The pairs that there must be room for to search a world: kernels write the first few of a word whether they are
  /// there or not.
  [[nodiscard]] static constexpr std::size_t roomFor(std::size_t boxes) noexcept {
    return pairsOf(boxes) + kVectorSlack;
  }

  Pair* pairs = nullptr;
  std::size_t capacity = 0;  ///< With the slack.
  std::uint64_t size = 0;

  /// If set, pairs are counted in `size` and not stored.
  bool countOnly = false;

  /// Whether pairs are ordered by their second box.
  bool bySecond = false;

  /// Which pairs are not filtered out: for each box, as a row, the bits of its partners; the same for all worlds. Null
  /// means all.
  const std::uint64_t* allowed = nullptr;

  /// If set, the memory of `pairs`, which grows as needed.
  Buffer<Pair>* growing = nullptr;

  /// If set, is given the pairs of a run of one world, or of two sets, where there may be no room for more; the last
  /// ones stay. Room for a part, and the slack, is enough then.
  const FunctionRef<void(std::span<const Pair>)>* emit = nullptr;
  std::uint64_t emitted = 0;

  /// Of all searches.
  [[nodiscard]] std::uint64_t found() const noexcept { return emitted + size; }

  /// Makes room for the pairs of some boxes, each with all of so many; returns of how many.
  std::size_t makeRoomForRows(std::size_t boxes) {
    if (emit == nullptr) return kWordBoxes;
    const std::size_t rows = (capacity - kVectorSlack - size) / boxes;
    if (rows >= kFanOut / 2) return rows;
    (*emit)({pairs, size});
    emitted += size;
    size = 0;
    return (capacity - kVectorSlack) / boxes;
  }

  [[nodiscard]] bool takes(std::size_t boxes) const noexcept {
    return countOnly || emit != nullptr || size + roomFor(boxes) <= capacity;
  }

  /// Makes room for so many more pairs; returns whether there is.
  bool makeRoom(std::size_t more) {
    if (size + more <= capacity) return true;
    if (growing == nullptr) return false;
    growing->grow(size + more);
    pairs = growing->data();
    capacity = growing->capacity();
    return true;
  }
};

/// Worlds of boxes in rows of six or three, one after the other, all pairs of each tested, up to a world that is too
/// large or that there may be no room for.
template <class T>
struct WorldsRun {
  BoxRun<T> boxes;
  const Worlds* worlds = nullptr;
  std::size_t world = 0;  ///< The next one; the one that it stopped at.
  std::size_t end = 0;
  std::size_t mostBoxes = kMostInWorld;
  WorldSink sink;

  /// pairEnd[k] receives the sink's size after world k.
  std::uint64_t* pairEnd = nullptr;
  std::uint64_t boxTests = 0;

  /// Of float64: whether the rows before, of this world or the last one, had many pairs, as the next ones then have;
  /// for speed only.
  bool hadMany = false;
};

/// Two sets of at least one and at most kMostInWorld boxes each, every row against every column. The sink gives pairs
/// out, and neither filters nor only counts them.
template <class T>
struct BetweenRun {
  BoxRun<T> rows;
  BoxRun<T> columns;
  WorldSink sink;  ///< Pairs are in the order of the rows, which are the second boxes where it says bySecond.
};

/// One world in double, the exact test of boxes with margins and a distance.
struct WideWorld {
  alignas(64) WorldTile<double> tile;
  std::size_t boxes;
  double distance;
  bool hasMargins;
  std::array<double, kMostInWorld> margins;                    ///< By place.
  std::array<std::uint64_t, kMostInWorld / kWordBoxes> alive;  ///< A bit for each place whose box can overlap others.

  /// Reads so many boxes of a set: those of the indices indexOf(i). isIn(box, margin) says which can overlap others,
  /// unless they are empty.
  template <class IndexOf, class IsIn>
  void read(std::size_t size, const BoxView& set, const IndexOf& indexOf, const IsIn& isIn) {
    boxes = size;
    hasMargins = set.hasMargins();
    alive.fill(0);
    std::size_t place = WorldPlaces::of(size).first;
    for (std::size_t i = 0; i < size; ++i, ++place) {
      const Box box = set[indexOf(i)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        tile[axis][place] = box.min[axis];
        tile[axis + 3][place] = box.max[axis];
      }
      margins[place] = set.margin(indexOf(i));
      if (isEmpty(box) || !isIn(box, margins[place])) continue;
      alive[place / kWordBoxes] |= std::uint64_t{1} << (place % kWordBoxes);
    }
  }
};

}  // namespace allpairs::engine
