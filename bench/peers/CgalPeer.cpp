// SPDX-License-Identifier: MIT
// CGAL::box_self_intersection_d: streamed segment trees that fall back to a sweep below a cutoff.
#include <CGAL/box_intersection_d.h>
#include <CGAL/version.h>

#include <array>

#include "Peer.h"

namespace allpairs::bench {

namespace {

/// As small as a box for CGAL can be: 28 bytes, its number for an id.
struct SmallBox {
  using NT = float;
  using ID = std::uint32_t;

  std::array<float, 3> min;
  std::array<float, 3> max;
  ID number;

  static int dimension() { return 3; }
  [[nodiscard]] float min_coord(int axis) const { return min[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] float max_coord(int axis) const { return max[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] ID id() const { return number; }
};

std::vector<SmallBox> smallBoxes(std::span<const float> rows) {
  std::vector<SmallBox> boxes(rows.size() / 6);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const float* const row = rows.data() + 6 * i;
    boxes[i] = {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, static_cast<std::uint32_t>(i)};
  }
  return boxes;
}

/// Sorts the boxes themselves.
class CgalByValue final : public Search {
 public:
  explicit CgalByValue(std::ptrdiff_t cutoff) : m_cutoff(cutoff) {}

  std::span<const Pair> find(std::span<const float> rows) override {
    m_boxes = smallBoxes(rows);
    const auto report = [this](const SmallBox& a, const SmallBox& b) { m_pairs.push_back({a.number, b.number}); };
    CGAL::box_self_intersection_d(m_boxes.begin(), m_boxes.end(), report, m_cutoff);
    return m_pairs;
  }

 private:
  std::ptrdiff_t m_cutoff;
  std::vector<SmallBox> m_boxes;
  std::vector<Pair> m_pairs;
};

/// Sorts pointers to boxes, as CGAL's manual advises.
class CgalByPointer final : public Search {
 public:
  explicit CgalByPointer(std::ptrdiff_t cutoff) : m_cutoff(cutoff) {}

  std::span<const Pair> find(std::span<const float> rows) override {
    m_boxes = smallBoxes(rows);
    m_pointers.reserve(m_boxes.size());
    for (const SmallBox& box : m_boxes) m_pointers.push_back(&box);
    const auto report = [this](const SmallBox* a, const SmallBox* b) { m_pairs.push_back({a->number, b->number}); };
    CGAL::box_self_intersection_d(m_pointers.begin(), m_pointers.end(), report, m_cutoff);
    return m_pairs;
  }

 private:
  std::ptrdiff_t m_cutoff;
  std::vector<SmallBox> m_boxes;
  std::vector<const SmallBox*> m_pointers;
  std::vector<Pair> m_pairs;
};

}  // namespace

Peer cgalPeer() {
  Peer peer{.name = "CGAL", .version = CGAL_VERSION_STR, .settings = {}};
  for (const std::ptrdiff_t cutoff : {10, 30, 100, 300, 1000, 3000}) {
    const std::string suffix = ", cutoff " + std::to_string(cutoff);
    peer.settings.push_back({"boxes" + suffix, [cutoff] { return std::make_unique<CgalByValue>(cutoff); }});
    peer.settings.push_back({"pointers" + suffix, [cutoff] { return std::make_unique<CgalByPointer>(cutoff); }});
  }
  return peer;
}

}  // namespace allpairs::bench
