// SPDX-License-Identifier: MIT
// ArborX's linear hierarchy in Kokkos's default space: a query for each box, or of one set its traversal that meets
// each pair once.
#include <ArborX.hpp>
#include <Kokkos_Core.hpp>
#include <detail/ArborX_HalfTraversal.hpp>

#include "SetPeer.h"

namespace allpairs::bench {

namespace {

using Space = Kokkos::DefaultHostExecutionSpace;
using Memory = Space::memory_space;

/// ArborX has no boxes of another precision than its tree's in one call.
template <class T>
using Boxes = Kokkos::View<ArborX::Box<3, T>*, Memory>;

template <class T>
Boxes<T> boxesOf(std::span<const T> rows) {
  Boxes<T> boxes(Kokkos::view_alloc("boxes", Kokkos::WithoutInitializing), rows.size() / 6);
  for (std::size_t i = 0; i < rows.size() / 6; ++i) {
    const T* const row = rows.data() + 6 * i;
    boxes(i) = {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
  }
  return boxes;
}

template <class T>
auto treeOf(std::span<const T> rows) {
  return ArborX::BoundingVolumeHierarchy(Space{}, ArborX::Experimental::attach_indices(boxesOf(rows)));
}

struct Overlapping {
  template <class Value>
  KOKKOS_FUNCTION auto operator()(const Value& box) const {
    return ArborX::intersects(box.value);
  }
};

template <class T>
class ArborxOfSets final : public SetSearch<T> {
 public:
  explicit ArborxOfSets(bool half) : m_half(half) {}

  std::span<const Pair> find(const Sets<T>& sets) override {
    clear();
    if (m_half && !sets.areTwo) {
      const auto meet = [this](const auto& a, const auto& b) { m_pairs.push_back({a.index, b.index}); };
      ArborX::Details::HalfTraversal(Space{}, treeOf(sets.first), meet, Overlapping{});
      return m_pairs;
    }
    const auto tree = treeOf(sets.areTwo ? sets.second : sets.first);
    const auto queries =
        ArborX::Experimental::attach_indices<unsigned>(ArborX::Experimental::make_intersects(boxesOf(sets.first)));
    tree.query(Space{}, queries, [&](const auto& query, const auto& box) {
      const auto i = static_cast<std::uint32_t>(ArborX::getData(query));
      const auto j = static_cast<std::uint32_t>(box.index);
      if (sets.areTwo || i < j) m_pairs.push_back({i, j});
    });
    return m_pairs;
  }

  void clear() override { m_pairs = {}; }

 private:
  bool m_half;
  std::vector<Pair> m_pairs;
};

/// Kokkos starts once a process.
void startKokkos() { static const Kokkos::ScopeGuard kokkos; }

}  // namespace

template <class T>
SetPeer<T> arborxOfSets() {
  startKokkos();
  return {"ArborX",
          {{"query of each box", [] { return std::make_unique<ArborxOfSets<T>>(false); }},
           {"each pair once", [] { return std::make_unique<ArborxOfSets<T>>(true); }}}};
}

template SetPeer<float> arborxOfSets<float>();
template SetPeer<double> arborxOfSets<double>();

}  // namespace allpairs::bench
