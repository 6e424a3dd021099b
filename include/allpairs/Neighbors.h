// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Span.h"

namespace allpairs {

/// In which rows a pair of boxes of one set is.
enum class NeighborRows : std::uint8_t {
  Full,  ///< In those of both boxes: row i has all partners of box i.
  Half,  ///< In that of the lower index: read one after the other, the rows are the pairs of overlaps().
};

/// The partners of each box, in compressed sparse rows (CSR): row i is the indices at the positions from offsets[i] on
/// and before offsets[i + 1].
struct Neighbors {
  std::vector<std::uint64_t> offsets;  ///< One more than there are rows.
  std::vector<std::uint32_t> indices;  ///< Ascending in each row.

  /// The number of rows: that of the boxes.
  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] Span<const std::uint32_t> operator[](std::size_t box) const& noexcept {
    return Span<const std::uint32_t>(indices).subspan(offsets[box], offsets[box + 1] - offsets[box]);
  }
  Span<const std::uint32_t> operator[](std::size_t box) const&& = delete;  // of a temporary: its rows are destroyed
};

/// The same, in memory of the search that found them.
struct NeighborsView {
  Span<const std::uint64_t> offsets;
  Span<const std::uint32_t> indices;

  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] Span<const std::uint32_t> operator[](std::size_t box) const noexcept {
    return indices.subspan(offsets[box], offsets[box + 1] - offsets[box]);
  }
};

/// Memory of the caller for rows of neighbors.
struct NeighborsMemory {
  Span<std::uint64_t> offsets;  ///< For one more than there are rows.
  Span<std::uint32_t> indices;  ///< For the pairs, twice in Full rows.
};

/// The partners of each box among the boxes of one set: the pairs of overlaps() as rows of a sparse matrix.
///
/// Options:   all apply but `order`: rows and what is in them ascend. maxPairs counts a pair once, in Full rows too.
/// Bad input: as for overlaps().
/// Cost:      as overlaps(); 8 bytes a box and 4 bytes an index, of which Full rows have two for each pair.
/// Threads:   as overlaps().
[[nodiscard]] Neighbors neighbors(const BoxView& boxes, NeighborRows rows = NeighborRows::Full,
                                  const OverlapOptions& options = {});

/// The partners in `second` of each box of `first`.
[[nodiscard]] Neighbors neighbors(const BoxView& first, const BoxView& second, const OverlapOptions& options = {});

}  // namespace allpairs
