// SPDX-License-Identifier: MIT
// Boost.Geometry's packed R-tree: boxes that overlap a box, and the nearest to a point.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <utility>

#include "QueryContest.h"

namespace allpairs::bench {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using Point = bg::model::point<float, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<Point>;
using Value = std::pair<TreeBox, std::uint32_t>;
using Tree = bgi::rtree<Value, bgi::rstar<8>>;

TreeBox boxOf(const float* row) { return {Point(row[0], row[1], row[2]), Point(row[3], row[4], row[5])}; }

std::vector<Value> valuesOf(const std::vector<float>& rows) {
  std::vector<Value> values;
  for (std::size_t i = 0; 6 * i < rows.size(); ++i) {
    values.emplace_back(boxOf(&rows[6 * i]), static_cast<std::uint32_t>(i));
  }
  return values;
}

class BoostIndex final : public QueryIndex {
 public:
  explicit BoostIndex(const QueryScene& scene) : m_tree(valuesOf(scene.rows)) {}

  [[nodiscard]] bool answers(QueryKind kind) const override {
    return kind != QueryKind::FirstHit && kind != QueryKind::AllHits;
  }

  void run(QueryKind kind, const QueryScene& scene) override {
    m_answers.clear();
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      kind == QueryKind::Overlapping ? overlapping(&scene.boxes[6 * i])
                                     : nearest(scene.points[i], kind == QueryKind::Nearest1 ? 1 : 8);
      m_answers.ends.push_back(m_answers.numbers.size());
    }
  }

  void collect(Answers& answers) const override { answers = m_answers; }

 private:
  void overlapping(const float* row) {
    const auto take = [&](const Value& value) { m_answers.numbers.push_back(value.second); };
    m_tree.query(bgi::intersects(boxOf(row)), boost::make_function_output_iterator(take));
  }

  void nearest(const std::array<double, 3>& at, unsigned count) {
    const Point point(static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]));
    const auto take = [&](const Value& value) {
      m_answers.numbers.push_back(std::sqrt(static_cast<double>(bg::comparable_distance(point, value.first))));
    };
    m_tree.query(bgi::nearest(point, count), boost::make_function_output_iterator(take));
  }

  Tree m_tree;
  Answers m_answers;
};

}  // namespace

void addBoostIndex(const QueryScene& scene, std::vector<QueryContender>& contenders) {
  contenders.push_back({"Boost.Geometry", "packed, nodes of 8", std::make_unique<BoostIndex>(scene)});
}

}  // namespace allpairs::bench
