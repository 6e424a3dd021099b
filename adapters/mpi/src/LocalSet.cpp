// SPDX-License-Identifier: MIT
#include "LocalSet.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace allpairs::mpi {
namespace {

constexpr std::uint32_t kAllBits = std::numeric_limits<std::uint32_t>::max();

template <class Number>
void packBounds(const LocalSet& set, std::span<const std::uint32_t> indices, std::vector<std::uint64_t>& words) {
  using Row = std::array<Number, 6>;
  words.resize(indices.size() * sizeof(Row) / sizeof(std::uint64_t));
  auto* to = reinterpret_cast<unsigned char*>(words.data());
  const BoxView::Corners<Number>* corners = nullptr;
  if constexpr (std::is_same_v<Number, double>) {
    if (set.boxes.isFloat64()) corners = &set.boxes.float64();
  } else {
    corners = &set.boxes.float32();  // all boxes are float32, or bounds would travel as float64
  }
  if (corners != nullptr && corners->isPacked()) {
    for (const std::uint32_t i : indices) {
      std::memcpy(to, corners->min.data + std::size_t{6} * i, sizeof(Row));
      to += sizeof(Row);
    }
    return;
  }
  for (const std::uint32_t i : indices) {
    const Box box = set.boxes[i];
    Row row{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[axis] = static_cast<Number>(box.min[axis]);
      row[axis + 3] = static_cast<Number>(box.max[axis]);
    }
    std::memcpy(to, &row, sizeof(row));
    to += sizeof(row);
  }
}

std::uint64_t valueAt(std::span<const std::uint32_t> values, std::size_t i, std::uint32_t otherwise) {
  return values.empty() ? otherwise : values[i];
}

std::uint32_t low(std::uint64_t word) { return static_cast<std::uint32_t>(word); }
std::uint32_t high(std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); }

template <class Number>
BoxView viewOf(std::span<const std::uint64_t> words) {
  return BoxView::fromRows(
      std::span(reinterpret_cast<const Number*>(words.data()), words.size() * sizeof(std::uint64_t) / sizeof(Number)));
}

}  // namespace

RecordLayout RecordLayout::of(const LocalSet& set) {
  RecordLayout layout;
  if (set.boxes.isFloat64()) layout.flags |= Float64;
  if (set.boxes.hasMargins()) layout.flags |= Margins;
  if (!set.bits.categories.empty() || !set.bits.masks.empty()) layout.flags |= Categories;
  if (!set.bits.groups.empty()) layout.flags |= Groups;
  return layout;
}

std::size_t RecordLayout::otherWords() const noexcept {
  return 1 + (has(Margins) ? 1U : 0U) + (has(Categories) ? 1U : 0U) + (has(Groups) ? 1U : 0U);
}

void packBoxes(const LocalSet& set, std::span<const std::uint32_t> indices, RecordLayout layout, PackedBoxes& packed) {
  if (layout.has(RecordLayout::Float64)) {
    packBounds<double>(set, indices, packed.bounds);
  } else {
    packBounds<float>(set, indices, packed.bounds);
  }
  packed.others.clear();
  packed.others.reserve(indices.size() * layout.otherWords());
  for (const std::uint32_t i : indices) {
    packed.others.push_back(set.firstId + i);
    if (layout.has(RecordLayout::Margins)) packed.others.push_back(std::bit_cast<std::uint64_t>(set.boxes.margin(i)));
    if (layout.has(RecordLayout::Categories)) {
      packed.others.push_back(valueAt(set.bits.masks, i, kAllBits) << 32 | valueAt(set.bits.categories, i, kAllBits));
    }
    if (layout.has(RecordLayout::Groups)) packed.others.push_back(valueAt(set.bits.groups, i, 0));
  }
}

void BoxRecords::unpack() {
  m_margins.clear();
  m_categories.clear();
  m_masks.clear();
  m_groups.clear();
  for (std::size_t i = 0; m_otherWords > 1 && i < size(); ++i) {
    std::size_t at = i * m_otherWords;
    if (m_layout.has(RecordLayout::Margins)) m_margins.push_back(std::bit_cast<double>(m_packed.others[++at]));
    if (m_layout.has(RecordLayout::Categories)) {
      m_categories.push_back(low(m_packed.others[++at]));
      m_masks.push_back(high(m_packed.others[at]));
    }
    if (m_layout.has(RecordLayout::Groups)) m_groups.push_back(low(m_packed.others[++at]));
  }
}

BoxView BoxRecords::boxes() const {
  BoxView boxes =
      m_layout.has(RecordLayout::Float64) ? viewOf<double>(m_packed.bounds) : viewOf<float>(m_packed.bounds);
  boxes.setMargins(m_margins);
  return boxes;
}

FilterBits BoxRecords::bits() const { return {.categories = m_categories, .masks = m_masks, .groups = m_groups}; }

}  // namespace allpairs::mpi
