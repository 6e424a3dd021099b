// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/Filter.h"

namespace allpairs::mpi {

/// The boxes that a rank was given of one set.
struct LocalSet {
  BoxView boxes{};
  FilterBits bits{};
  std::uint64_t firstId = 0;   ///< The number of its first box among those of all ranks.
  double maxMargin = 0.0;      ///< The greatest margin of a box that these may be paired with, on any rank.
  std::uint64_t allBoxes = 0;  ///< Of all ranks.
};

/// What a box is when it travels, the same on all ranks: its bounds, and beside them its number and what any rank gave.
struct RecordLayout {
  enum Flag : std::uint64_t { Float64 = 1, Margins = 2, Categories = 4, Groups = 8 };

  std::uint64_t flags = 0;

  [[nodiscard]] static RecordLayout of(const LocalSet& set);
  [[nodiscard]] bool has(Flag flag) const noexcept { return (flags & flag) != 0; }

  /// The words of 8 bytes of its bounds, and of what is beside them.
  [[nodiscard]] std::size_t boundsWords() const noexcept { return has(Float64) ? 6 : 3; }
  [[nodiscard]] std::size_t otherWords() const noexcept;
};

/// Boxes as they travel. Bounds lie together, in rows of 6, for the search to read.
struct PackedBoxes {
  std::vector<std::uint64_t> bounds{};
  std::vector<std::uint64_t> others{};
};

/// Replaces `packed` by some boxes of a set, by index.
void packBoxes(const LocalSet& set, std::span<const std::uint32_t> indices, RecordLayout layout, PackedBoxes& packed);

/// Boxes that came from other ranks.
class BoxRecords {
 public:
  /// The numbers of the boxes by index, for loops that read many of them.
  class Ids {
   public:
    Ids(const std::uint64_t* words, std::size_t step) : m_words(words), m_step(step) {}
    std::uint64_t operator()(std::size_t i) const noexcept { return m_words[i * m_step]; }

   private:
    const std::uint64_t* m_words;
    std::size_t m_step;
  };

  explicit BoxRecords(RecordLayout layout) : m_layout(layout), m_otherWords(layout.otherWords()) {}

  /// What came; unpack() is called when it is here.
  [[nodiscard]] PackedBoxes& packed() noexcept { return m_packed; }
  void unpack();

  /// Views of what is here.
  [[nodiscard]] BoxView boxes() const;
  [[nodiscard]] FilterBits bits() const;

  [[nodiscard]] std::size_t size() const noexcept { return m_packed.bounds.size() / m_layout.boundsWords(); }
  [[nodiscard]] Ids ids() const noexcept { return {m_packed.others.data(), m_otherWords}; }

 private:
  PackedBoxes m_packed;
  RecordLayout m_layout;
  std::size_t m_otherWords;
  std::vector<double> m_margins;
  std::vector<std::uint32_t> m_categories;
  std::vector<std::uint32_t> m_masks;
  std::vector<std::uint32_t> m_groups;
};

}  // namespace allpairs::mpi
