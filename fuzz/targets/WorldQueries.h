// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "../BoxesInMemory.h"
#include "../Choices.h"
#include "allpairs/World.h"
#include "engine/WorldOracle.h"

namespace allpairs::fuzz {

inline constexpr std::size_t kMostInWorld = 250;  // The double loop is quadratic.
inline constexpr std::array<std::uint32_t, 4> kWorlds{0, 1, kEveryWorld - 1, kEveryWorld};

/// Calls the function with a view of the boxes, which become float32 if the input says so.
template <class Function>
void withView(Choices& choices, std::vector<Box>& boxes, const Function& function) {
  const std::size_t layout = choices.below(2 * BoxesInMemory<float>::kLayouts);
  if (layout % 2 == 0) return function(BoxesInMemory<double>(boxes, layout / 2).view());
  for (Box& box : boxes) box = asFloat32(box);
  function(BoxesInMemory<float>(boxes, layout / 2).view());
}

/// Queries of a world, one at a time and many at once, beside those of the oracle.
class WorldQueries {
 public:
  WorldQueries(Choices& choices, const World& world, const test::WorldOracle& oracle)
      : m_choices(choices), m_world(world), m_oracle(oracle) {}

  void compareOverlapping() {
    std::vector<Box> boxes = m_choices.boxes(20);
    const QueryFilter wanted = filter();
    withView(m_choices, boxes, [&](const BoxView& view) {
      const ResultLists<BoxId> lists = m_world.findOverlapping(view, wanted);
      require(lists.size() == boxes.size(), "findOverlapping gives a list for each box");
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        require(std::ranges::equal(lists[i], m_oracle.overlapping(boxes[i], wanted)), "findOverlapping is exact");
      }
    });
    require(std::ranges::equal(m_world.findOverlapping(boxes[0], wanted), m_oracle.overlapping(boxes[0], wanted)),
            "findOverlapping of one box is exact");
  }

  void compareSweeps() {
    const QueryFilter wanted = filter();
    std::vector<BoxSweep> sweeps(1 + m_choices.below(4));
    for (BoxSweep& sweep : sweeps) {
      sweep.box = m_choices.box();
      sweep.motion = finitePoint();
      sweep.length = std::abs(m_choices.number());
    }
    std::vector<SweepHit> first(sweeps.size());
    m_world.findFirst(sweeps, first, wanted);
    const ResultLists<SweepHit> lists = m_world.findAll(sweeps, wanted);
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      const std::vector<SweepHit> expected = m_oracle.along(sweeps[i], wanted);
      require(std::ranges::equal(lists[i], expected), "findAll of a sweep is exact");
      require(first[i] == (expected.empty() ? SweepHit{} : expected.front()), "findFirst of a sweep is exact");
    }
    compareRay(wanted);
  }

  void compareNearest() {
    const QueryFilter wanted = filter();
    const std::array<double, 3> point = finitePoint();
    const std::size_t count = m_choices.below(kMostInWorld + 20);
    require(std::ranges::equal(m_world.findNearest(point, count, wanted), m_oracle.nearest(point, count, wanted)),
            "findNearest is exact");
    const Box box = m_choices.box();
    require(std::ranges::equal(m_world.findNearest(box, count, wanted), m_oracle.nearest(box, count, wanted)),
            "findNearest to a box is exact");
    const std::array<std::array<double, 3>, 2> points{point, {point[1], point[2], point[0]}};
    compareMany(points, m_world.findNearest(Span<const std::array<double, 3>>(points), count, wanted), count, wanted);
    const std::array<Box, 2> boxes{asFloat32(box), box};
    compareMany(boxes, m_world.findNearest(BoxView(boxes), count, wanted), count, wanted);
    compareNear(box, count, wanted);
  }

 private:
  void compareRay(const QueryFilter& wanted) {
    const Ray ray{finitePoint(), finitePoint(), std::abs(m_choices.number())};
    const std::array<Ray, 2> rays{ray, {ray.direction, ray.origin, ray.length}};
    const ResultLists<SweepHit> all = m_world.findAll(Span<const Ray>(rays), wanted);
    std::array<SweepHit, 2> first;
    m_world.findFirst(Span<const Ray>(rays), first, wanted);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray& each = rays[i];
      const auto expected = m_oracle.along({{each.origin, each.origin}, each.direction, each.length}, wanted);
      require(std::ranges::equal(m_world.findAll(each, wanted), expected), "findAll of a ray is exact");
      require(m_world.findFirst(each, wanted) == (expected.empty() ? SweepHit{} : expected.front()),
              "findFirst of a ray is exact");
      require(std::ranges::equal(all[i], expected), "findAll of many rays is exact");
      require(first[i] == (expected.empty() ? SweepHit{} : expected.front()), "findFirst of many rays is exact");
    }
  }

  template <class Queries>
  void compareMany(const Queries& queries, const ResultLists<Neighbor>& lists, std::size_t count,
                   const QueryFilter& wanted) const {
    require(lists.size() == queries.size(), "findNearest gives a list for each query");
    for (std::size_t i = 0; i < queries.size(); ++i) {
      require(std::ranges::equal(lists[i], m_oracle.nearest(queries[i], count, wanted)),
              "findNearest of many is exact");
    }
  }

  /// Begins with the distance of one of the boxes; the visitor keeps it, reduces it to that of each box it is told, or
  /// ends with the first.
  void compareNear(const Box& box, std::size_t choice, const QueryFilter& wanted) const {
    const std::vector<Neighbor> all = m_oracle.nearest(box, kMostInWorld, wanted);
    std::map<BoxId, double> distances;
    for (const Neighbor& each : all) distances[each.id] = each.distance;
    double within = all.empty() ? std::numeric_limits<double>::infinity() : all[choice % all.size()].distance;
    std::set<BoxId> seen;
    m_world.visitNear(
        box, within,
        [&](BoxId id) {
          require(within >= 0.0, "nothing is visited after the end");
          require(seen.insert(id).second, "no box is visited twice");
          require(distances.contains(id), "what is visited passes the filter and is near");
          if (choice % 3 == 1) within = std::min(within, distances[id]);
          if (choice % 3 == 2) within = -1.0;
          return within;
        },
        wanted);
    for (const Neighbor& each : all) {
      require(each.distance > within || seen.contains(each.id), "none that is left out is within the last distance");
    }
  }

  QueryFilter filter() {
    QueryFilter result;
    const std::uint8_t parts = m_choices.byte();
    if (parts < 128) return result;
    result.mask = parts % 8U;
    result.category = 1U << parts / 8 % 3;
    result.staticBoxes = (parts & 64U) != 0;
    result.dynamicBoxes = (parts & 32U) != 0;
    result.world = kWorlds[m_choices.below(kWorlds.size())];
    return result;
  }

  std::array<double, 3> finitePoint() { return {m_choices.finite(), m_choices.finite(), m_choices.finite()}; }

  Choices& m_choices;
  const World& m_world;
  const test::WorldOracle& m_oracle;
};

}  // namespace allpairs::fuzz
