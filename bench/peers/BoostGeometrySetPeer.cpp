// SPDX-License-Identifier: MIT
// Boost.Geometry's R-tree in float32 and float64, within one set and between two: the larger set is packed, and asked
// once for each box of the smaller one.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include "SetPeer.h"

namespace allpairs::bench {

namespace {

namespace bg = boost::geometry;

template <class T, std::size_t kNodeSize>
class TreeOfSets final : public SetSearch<T> {
 public:
  std::span<const Pair> find(const Sets<T>& sets) override {
    clear();
    if (!sets.areTwo) {
      m_tree = Tree(entriesOf(sets.first));
      for (const Entry& entry : m_tree) queryWithin(entry);
    } else if (sets.first.size() < sets.second.size()) {
      m_tree = Tree(entriesOf(sets.second));
      query(sets.first, [this](std::uint32_t asked, std::uint32_t held) { m_pairs.push_back({asked, held}); });
    } else {
      m_tree = Tree(entriesOf(sets.first));
      query(sets.second, [this](std::uint32_t asked, std::uint32_t held) { m_pairs.push_back({held, asked}); });
    }
    return m_pairs;
  }

  void clear() override {
    m_tree = Tree();
    m_pairs = {};
  }

 private:
  using Point = bg::model::point<T, 3, bg::cs::cartesian>;
  using Bounds = bg::model::box<Point>;
  using Entry = std::pair<Bounds, std::uint32_t>;
  using Tree = bg::index::rtree<Entry, bg::index::linear<kNodeSize>>;

  static Bounds boundsOf(const T* row) { return {Point(row[0], row[1], row[2]), Point(row[3], row[4], row[5])}; }

  static std::vector<Entry> entriesOf(std::span<const T> rows) {
    std::vector<Entry> entries;
    entries.reserve(rows.size() / 6);
    for (std::size_t i = 0; i < rows.size() / 6; ++i) {
      entries.emplace_back(boundsOf(rows.data() + 6 * i), static_cast<std::uint32_t>(i));
    }
    return entries;
  }

  void queryWithin(const Entry& entry) {
    const auto report = [&](const Entry& other) {
      if (entry.second < other.second) m_pairs.push_back({entry.second, other.second});
    };
    m_tree.query(bg::index::intersects(entry.first), boost::make_function_output_iterator(report));
  }

  template <class Report>
  void query(std::span<const T> rows, const Report& report) {
    for (std::uint32_t i = 0; i < rows.size() / 6; ++i) {
      const auto reportOne = [&](const Entry& held) { report(i, held.second); };
      m_tree.query(bg::index::intersects(boundsOf(rows.data() + 6 * std::size_t{i})),
                   boost::make_function_output_iterator(reportOne));
    }
  }

  Tree m_tree;
  std::vector<Pair> m_pairs;
};

template <class T, std::size_t kNodeSize>
SetSetting<T> treesOf() {
  return {"nodes of " + std::to_string(kNodeSize), [] { return std::make_unique<TreeOfSets<T, kNodeSize>>(); }};
}

}  // namespace

template <class T>
SetPeer<T> boostGeometryOfSets() {
  return {"Boost.Geometry", {treesOf<T, 4>(), treesOf<T, 8>(), treesOf<T, 16>()}};
}

template SetPeer<float> boostGeometryOfSets<float>();
template SetPeer<double> boostGeometryOfSets<double>();

}  // namespace allpairs::bench
