// SPDX-License-Identifier: MIT
// A few boxes against each other as they lie in the caller's memory: hits of each row as bits, and then pairs of bits.

#if defined(ALLPAIRS_FEW_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_FEW_KERNEL_INL_H
#undef ALLPAIRS_FEW_KERNEL_INL_H
#else
#define ALLPAIRS_FEW_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/Kernels.h"
#include "kernels/WorldsKernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Pairs of a row that are written unasked: most rows of few boxes have no more (few_benchmark).
constexpr std::size_t kUnaskedOfFew = 2;

/// From so many pairs in a word on they are selected by vectors, which takes the same time for any number
/// (few_benchmark).
constexpr int kManyBits = 8;

/// Boxes as they are, of float32 or of float64, an array for each bound.
template <class T>
using FewColumns = std::array<std::array<T, kMostFew>, 6>;

/// As many boxes as a vector has lanes, from rows of six that follow each other.
template <class T>
HWY_INLINE void readColumns(const T* rows, FewColumns<T>& columns, std::size_t at) {
  const hn::CappedTag<T, kFanOut> d;
  hn::Vec<decltype(d)> bound[6];
  loadRows(d, rows, bound);
  for (std::size_t k = 0; k < 6; ++k) hn::StoreU(bound[k], d, &columns[k][at]);
}

/// The same of any number of boxes; what follows the last one is unspecified.
template <class T>
HWY_INLINE void readAllColumns(const T* rows, std::size_t count, FewColumns<T>& columns) {
  const std::size_t lanes = hn::Lanes(hn::CappedTag<T, kFanOut>());
  std::size_t at = 0;
  for (; at + lanes <= count; at += lanes) readColumns(rows + 6 * at, columns, at);
  if (at == count) return;
  std::array<T, 6 * kFanOut> rest;
  std::copy_n(rows + 6 * at, 6 * (count - at), rest.data());
  readColumns(rest.data(), columns, at);
}

/// The columns in vectors from `begin` up to `end`, all in one word, that a row overlaps, as bits of that word. No
/// comparison is true of an empty box, and nothing is rounded.
template <class T>
HWY_INLINE std::uint64_t hitsOf(const T* row, const FewColumns<T>& columns, std::size_t begin, std::size_t end) {
  const hn::CappedTag<T, kFanOut> d;
  std::uint64_t bits = 0;
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const auto from = [&](std::size_t axis)
                          HWY_ATTR { return hn::Max(hn::Set(d, row[axis]), hn::LoadU(d, &columns[axis][i])); };
    const auto to = [&](std::size_t axis)
                        HWY_ATTR { return hn::Min(hn::Set(d, row[axis + 3]), hn::LoadU(d, &columns[axis + 3][i])); };
    const auto x = hn::Le(from(0), to(0));
    const auto y = hn::Le(from(1), to(1));
    const auto z = hn::Le(from(2), to(2));
    bits |= std::uint64_t{allBitsOf(d, hn::And(hn::And(x, y), z))} << (i % kWordBoxes);
  }
  return bits;
}

/// So many bits, from the lowest on; fewer than a word has.
HWY_INLINE std::uint64_t lowBits(std::size_t count) { return ~(~std::uint64_t{0} << count); }

/// Writes a vector of pairs, of which `ids` come first, or second.
template <bool kIdsSecond>
HWY_INLINE void storePairs(hn::Vec<IdTag> ids, hn::Vec<IdTag> others, Pair* pairs) {
  const IdTag d;
  auto* const to = reinterpret_cast<std::uint32_t*>(pairs);
  if (kIdsSecond) {
    hn::StoreInterleaved2(others, ids, d, to);
  } else {
    hn::StoreInterleaved2(ids, others, d, to);
  }
}

/// Writes the pairs of a row with a word of which many bits are set; returns how many there are.
template <bool kRowSecond>
HWY_INLINE std::size_t writeManyBits(std::uint64_t bits, std::uint32_t row, std::uint32_t firstOfWord, Pair* pairs) {
  const IdTag d;
  const auto rows = hn::Set(d, row);
  std::size_t size = 0;
  for (std::size_t i = 0; i < kWordBoxes; i += hn::Lanes(d), bits >>= hn::Lanes(d)) {
    const std::uint64_t some = bits & lowBits(hn::Lanes(d));
    storePairs<kRowSecond>(rows, lanesOfBits(d, numbersFrom(firstOfWord + i), some), pairs + size);
    size += static_cast<std::size_t>(std::popcount(some));
  }
  return size;
}

template <class T, bool kRowSecond, bool kOneWord>
HWY_INLINE std::size_t searchFew(PlainSearch<T>& search, Pair* pairs) {
  alignas(64) FewColumns<T> columns;
  readAllColumns(search.columns, search.columnCount, columns);
  const std::size_t lastWord = kOneWord ? 0 : (search.columnCount - 1) / kWordBoxes;
  const std::uint64_t lastBits = ~std::uint64_t{0} >> (kWordBoxes - 1 - (search.columnCount - 1) % kWordBoxes);
  std::size_t size = 0;
  std::size_t row = search.rowBegin;
  for (; row < search.rowCount && size + search.columnCount <= search.room; ++row) {
    for (std::size_t word = 0; word <= lastWord; ++word) {
      const std::size_t end = kOneWord ? search.columnCount : std::min(search.columnCount, (word + 1) * kWordBoxes);
      std::uint64_t bits = hitsOf(search.rows + 6 * row, columns, word * kWordBoxes, end);
      if (word == lastWord) bits &= lastBits;
      const auto firstOfWord = static_cast<std::uint32_t>(word * kWordBoxes);
      const auto number = static_cast<std::uint32_t>(row);
      size += std::popcount(bits) > kManyBits
                  ? writeManyBits<kRowSecond>(bits, number, firstOfWord, pairs + size)
                  : writeBits<kRowSecond, kUnaskedOfFew>(bits, number, firstOfWord, pairs + size);
    }
  }
  search.rowBegin = row;
  return size;
}

/// The same, for what is known of a search only now.
template <class T, bool kRowSecond>
HWY_INLINE std::size_t searchFew(PlainSearch<T>& search, Pair* pairs) {
  return search.columnCount <= kWordBoxes ? searchFew<T, kRowSecond, true>(search, pairs)
                                          : searchFew<T, kRowSecond, false>(search, pairs);
}

template <class T>
std::size_t searchFew(PlainSearch<T>& search, Pair* pairs) {
  return search.rowSecond ? searchFew<T, true>(search, pairs) : searchFew<T, false>(search, pairs);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_FEW_KERNEL_INL_H
