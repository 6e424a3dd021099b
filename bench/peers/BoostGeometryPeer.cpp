// SPDX-License-Identifier: MIT
// Boost.Geometry's R-tree, packed when it is made, asked once for each box.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <boost/version.hpp>

#include "Peer.h"

namespace allpairs::bench {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<float, 3, bg::cs::cartesian>;
using PackedBox = bg::model::box<Point>;
using Entry = std::pair<PackedBox, std::uint32_t>;

template <std::size_t kNodeSize>
class PackedTree final : public Search {
 public:
  std::span<const Pair> find(std::span<const float> rows) override {
    std::vector<Entry> entries;
    entries.reserve(rows.size() / 6);
    for (std::size_t i = 0; i < rows.size() / 6; ++i) {
      const float* const row = rows.data() + 6 * i;
      entries.emplace_back(PackedBox({row[0], row[1], row[2]}, {row[3], row[4], row[5]}),
                           static_cast<std::uint32_t>(i));
    }
    m_tree = Tree(entries);
    for (const Entry& entry : m_tree) queryOne(entry);
    return m_pairs;
  }

 private:
  using Tree = bg::index::rtree<Entry, bg::index::linear<kNodeSize>>;

  void queryOne(const Entry& entry) {
    const auto report = [&](const Entry& other) {
      if (entry.second < other.second) m_pairs.push_back({entry.second, other.second});
    };
    m_tree.query(bg::index::intersects(entry.first), boost::make_function_output_iterator(report));
  }

  Tree m_tree;
  std::vector<Pair> m_pairs;
};

template <std::size_t kNodeSize>
Setting nodesOf() {
  return {"nodes of " + std::to_string(kNodeSize), [] { return std::make_unique<PackedTree<kNodeSize>>(); }};
}

}  // namespace

Peer boostGeometryPeer() {
  return {.name = "Boost.Geometry",
          .version = std::to_string(BOOST_VERSION / 100000) + "." + std::to_string(BOOST_VERSION / 100 % 1000),
          .settings = {nodesOf<4>(), nodesOf<8>(), nodesOf<16>(), nodesOf<32>()}};
}

}  // namespace allpairs::bench
