// SPDX-License-Identifier: MIT
// CGAL's box intersection in float32 and float64, within one set and between two.
#include <CGAL/box_intersection_d.h>

#include <array>
#include <type_traits>

#include "SetPeer.h"

namespace allpairs::bench {

namespace {

/// A box as CGAL takes it; the ids of two sets differ.
template <class T>
struct CgalBox {
  using NT = T;
  using ID = std::uint32_t;

  std::array<T, 6> bounds;
  ID number;
  ID unique;

  static int dimension() { return 3; }
  [[nodiscard]] T min_coord(int axis) const { return bounds[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] T max_coord(int axis) const { return bounds[static_cast<std::size_t>(axis) + 3]; }
  [[nodiscard]] ID id() const { return unique; }
};

template <class T>
std::vector<CgalBox<T>> cgalBoxes(std::span<const T> rows, std::size_t firstId) {
  std::vector<CgalBox<T>> boxes(rows.size() / 6);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::copy_n(rows.data() + 6 * i, 6, boxes[i].bounds.begin());
    boxes[i].number = static_cast<std::uint32_t>(i);
    boxes[i].unique = static_cast<std::uint32_t>(firstId + i);
  }
  return boxes;
}

template <class T>
std::vector<const CgalBox<T>*> pointersTo(const std::vector<CgalBox<T>>& boxes) {
  std::vector<const CgalBox<T>*> pointers;
  pointers.reserve(boxes.size());
  for (const CgalBox<T>& box : boxes) pointers.push_back(&box);
  return pointers;
}

/// Sorts the boxes themselves, or pointers to them.
template <class T>
class CgalOfSets final : public SetSearch<T> {
 public:
  CgalOfSets(std::ptrdiff_t cutoff, bool byPointer) : m_cutoff(cutoff), m_byPointer(byPointer) {}

  std::span<const Pair> find(const Sets<T>& sets) override {
    clear();
    m_first = cgalBoxes(sets.first, 0);
    if (sets.areTwo) m_second = cgalBoxes(sets.second, m_first.size());
    if (m_byPointer) {
      std::vector<const CgalBox<T>*> first = pointersTo(m_first);
      std::vector<const CgalBox<T>*> second = pointersTo(m_second);
      cross(first, second, sets.areTwo);
    } else {
      cross(m_first, m_second, sets.areTwo);
    }
    return m_pairs;
  }

  void clear() override {
    m_first = {};
    m_second = {};
    m_pairs = {};
  }

 private:
  static const CgalBox<T>& boxOf(const CgalBox<T>& box) { return box; }
  static const CgalBox<T>& boxOf(const CgalBox<T>* box) { return *box; }

  template <class Boxes>
  void cross(Boxes& first, Boxes& second, bool areTwo) {
    const auto report = [this](const auto& a, const auto& b) { m_pairs.push_back({boxOf(a).number, boxOf(b).number}); };
    if (areTwo) {
      CGAL::box_intersection_d(first.begin(), first.end(), second.begin(), second.end(), report, m_cutoff);
    } else {
      CGAL::box_self_intersection_d(first.begin(), first.end(), report, m_cutoff);
    }
  }

  std::ptrdiff_t m_cutoff;
  bool m_byPointer;
  std::vector<CgalBox<T>> m_first;
  std::vector<CgalBox<T>> m_second;
  std::vector<Pair> m_pairs;
};

}  // namespace

template <class T>
SetPeer<T> cgalOfSets() {
  SetPeer<T> peer{"CGAL", {}};
  for (const std::ptrdiff_t cutoff : {10, 100, 1000}) {
    for (const bool byPointer : {false, true}) {
      peer.settings.push_back({(byPointer ? "pointers, cutoff " : "boxes, cutoff ") + std::to_string(cutoff),
                               [=] { return std::make_unique<CgalOfSets<T>>(cutoff, byPointer); }});
    }
  }
  return peer;
}

template SetPeer<float> cgalOfSets<float>();
template SetPeer<double> cgalOfSets<double>();

}  // namespace allpairs::bench
