// SPDX-License-Identifier: MIT
// CGAL::box_intersection_d between two sets.
#include <CGAL/box_intersection_d.h>

#include <array>

#include "ElementLists.h"

namespace allpairs::bench {
namespace {

struct SmallBox {
  using NT = float;
  using ID = std::uint32_t;

  std::array<float, 6> bounds;
  ID number;
  ID unique;  // CGAL needs ids that differ between the two sets

  static int dimension() { return 3; }
  [[nodiscard]] float min_coord(int axis) const { return bounds[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] float max_coord(int axis) const { return bounds[static_cast<std::size_t>(axis) + 3]; }
  [[nodiscard]] ID id() const { return unique; }
};

std::vector<SmallBox> boxesOf(std::span<const float> rows, std::size_t firstId) {
  std::vector<SmallBox> boxes(rows.size() / 6);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(6 * i), 6, boxes[i].bounds.begin());
    boxes[i].number = static_cast<std::uint32_t>(i);
    boxes[i].unique = static_cast<std::uint32_t>(firstId + i);
  }
  return boxes;
}

}  // namespace

std::vector<Pair> cgalBetween(std::span<const float> first, std::span<const float> second, std::ptrdiff_t cutoff) {
  std::vector<SmallBox> a = boxesOf(first, 0);
  std::vector<SmallBox> b = boxesOf(second, a.size());
  std::vector<Pair> pairs;
  const auto report = [&pairs](const SmallBox& x, const SmallBox& y) { pairs.push_back({x.number, y.number}); };
  CGAL::box_intersection_d(a.begin(), a.end(), b.begin(), b.end(), report, cutoff);
  return pairs;
}

}  // namespace allpairs::bench
