// SPDX-License-Identifier: MIT
// Random lives of a world, thousands of operations each, against an oracle that recomputes everything in each step.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "WorldOracle.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// What kind of life a world leads.
struct Life {
  std::size_t boxes = 50;  ///< About so many at a time.
  std::size_t steps = 20;
  double movedShare = 1.0;  ///< Of the boxes in a step.
  double staticShare = 0.0;
  bool float32 = true;
  bool margins = false;
  bool filters = false;
  bool jumps = false;
  bool extremes = false;   ///< Whether some boxes end where the numbers do.
  std::size_t worlds = 0;  ///< World numbers; 0 if boxes are given none.
  double sharedShare = 0.0;
  bool resets = false;  ///< Whether only boxes of one world move in a step.
  double distance = 0.0;
  std::uint32_t seed = 0;
};

std::ostream& operator<<(std::ostream& out, const Life& life) {
  return out << life.boxes << " boxes, " << life.steps << " steps, moved " << life.movedShare << ", static "
             << life.staticShare << (life.float32 ? ", float32" : ", float64") << (life.margins ? ", margins" : "")
             << (life.filters ? ", filters" : "") << (life.jumps ? ", jumps" : "")
             << (life.extremes ? ", extremes" : "") << ", " << life.worlds << " worlds, shared " << life.sharedShare
             << (life.resets ? ", resets" : "") << ", distance " << life.distance << ", seed " << life.seed;
}

/// Leads the life with a world and the oracle side by side.
class Lives {
 public:
  Lives(const Life& life, const WorldOptions& options) : m_life(life), m_world(options), m_random(life.seed) {
    m_oracle.distance = life.distance;
    m_oracle.order = options.order;
    // Boxes of different worlds are in the same place.
    const double boxes = static_cast<double>(life.boxes) / static_cast<double>(std::max<std::size_t>(1, life.worlds));
    while (m_side * m_side * m_side < boxes) m_side += 0.25;
    for (std::size_t i = 0; i < life.worlds; ++i) noteWorld(anyWorld(i));
    if (life.worlds != 0) noteWorld(kEveryWorld);
  }

  void lead() {
    addBoxes(m_life.boxes);
    for (std::size_t i = 0; i < m_life.steps; ++i) {
      change();
      if (chance(0.3)) compareQueries();
      compareStep();
      if (chance(0.3)) compareQueries();
    }
  }

 private:
  double uniform() { return static_cast<double>(m_random()) * 0x1p-32; }
  bool chance(double p) { return uniform() < p; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }

  double round(double x) const { return m_life.float32 ? test::asFloat32(x) : x; }

  /// Mostly a small box; now and then one that is large, flat, empty, or without end, and often on a grid, to touch.
  Box anyBox() {
    Box box;
    const double kind = uniform();
    const double size = kind < 0.05 ? 0.5 * m_side : 1.0;
    const bool snapped = chance(0.3);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double low = m_side * uniform();
      double high = low + size * (kind > 0.95 ? 0.0 : 0.4 + 0.8 * uniform());
      if (snapped) low = 0.5 * std::floor(2 * low), high = 0.5 * std::ceil(2 * high);
      box.min[axis] = round(low);
      box.max[axis] = round(high);
    }
    if (chance(0.01)) std::swap(box.min[0], box.max[0]);
    if (chance(0.005)) box.max[below(3)] = test::kInfinity;
    if (m_life.extremes && chance(0.3)) stretch(box);
    return box;
  }

  /// To where float32 ends or float64 does, or beyond; now and then it becomes empty.
  void stretch(Box& box) {
    constexpr std::array<double, 3> kEnds{test::kMostOfFloat, test::kInfinity, test::kMost};
    for (const std::size_t axis : {below(3), below(3)}) {
      for (double* const bound : {&box.min[axis], &box.max[axis]}) {
        if (chance(0.5)) *bound = (chance(0.5) ? 1.0 : -1.0) * kEnds[below(m_life.float32 ? 2 : 3)];
      }
    }
  }

  /// Not one after the other, and some as large as can be.
  static std::uint32_t anyWorld(std::size_t i) {
    return i % 3 == 2 ? kEveryWorld - static_cast<std::uint32_t>(i) : static_cast<std::uint32_t>(7 * i % 64);
  }

  void noteWorld(std::uint32_t number) {
    m_each[number].only = number;
    m_each[number].distance = m_oracle.distance;
    m_each[number].order = m_oracle.order;
  }

  Box moved(Box box) {
    if (chance(m_life.jumps ? 0.2 : 0.01)) return anyBox();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double by = 0.1 * (uniform() - 0.5);
      box.min[axis] = round(box.min[axis] + by);
      box.max[axis] = round(box.max[axis] + by);
    }
    return box;
  }

  BoxProperties anyProperties() {
    BoxProperties p;
    p.isStatic = chance(m_life.staticShare);
    if (m_life.margins) p.margin = 0.1 * static_cast<double>(below(5)) - 0.1;
    if (m_life.worlds != 0) p.world = chance(m_life.sharedShare) ? kEveryWorld : anyWorld(below(m_life.worlds));
    if (!m_life.filters) return p;
    p.category = 1U << below(3);
    p.mask = static_cast<std::uint32_t>(below(8));
    p.group = static_cast<std::uint32_t>(below(4));
    return p;
  }

  void addBoxes(std::size_t count) {
    std::vector<Box> boxes(count);
    std::vector<BoxProperties> properties(count);
    for (Box& box : boxes) box = anyBox();
    for (BoxProperties& p : properties) p = anyProperties();
    std::vector<BoxId> ids(count);
    m_world.add(boxes, properties, ids);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_FALSE(m_oracle.boxes.contains(ids[i])) << "the id is in use";
      ASSERT_FALSE(wasInStep(ids[i])) << "its old pairs haven't ended yet";
      m_oracle.boxes[ids[i]] = {boxes[i], properties[i]};
    }
  }

  bool wasInStep(BoxId id) const {
    return std::any_of(m_oracle.pairs.begin(), m_oracle.pairs.end(),
                       [&](Pair p) { return p.first == id || p.second == id; });
  }

  std::vector<BoxId> someIds(double share) {
    std::vector<BoxId> ids;
    for (const auto& [id, entry] : m_oracle.boxes) {
      if (chance(share)) ids.push_back(id);
    }
    return ids;
  }

  void moveSome() {
    std::vector<Box> boxes;
    std::vector<BoxId> ids;
    const std::uint32_t reset = m_life.worlds == 0 ? 0 : anyWorld(below(m_life.worlds));
    for (const BoxId id : someIds(m_life.resets ? 1.0 : m_life.movedShare)) {
      if (m_life.resets && m_oracle.boxes[id].properties.world != reset) continue;
      if (m_oracle.boxes[id].properties.isStatic && !chance(0.05)) continue;
      ids.push_back(id);
      boxes.push_back(moved(m_oracle.boxes[id].box));
      m_oracle.boxes[id].box = boxes.back();
    }
    m_world.move(ids, boxes);
  }

  void removeSome() {
    const std::vector<BoxId> ids = someIds(chance(0.02) ? 0.9 : 0.02);
    m_world.remove(ids);
    for (const BoxId id : ids) m_oracle.boxes.erase(id);
    addBoxes(below(2 * ids.size() + 2));
  }

  void changeSome() {
    const std::vector<BoxId> ids = someIds(0.05);
    std::vector<BoxProperties> properties;
    for (const BoxId id : ids) {
      properties.push_back(anyProperties());
      m_oracle.boxes[id].properties = properties.back();
    }
    if (!ids.empty()) m_world.setProperties(ids, properties);
  }

  void change() {
    if (chance(0.1)) return;
    moveSome();
    if (chance(m_life.resets ? 0.2 : 0.5)) removeSome();
    if (chance(m_life.resets ? 0.1 : 0.3)) changeSome();
    if (chance(0.2)) moveSome();
    if (chance(0.05)) m_world.shrink();
    ASSERT_EQ(m_world.size(), m_oracle.boxes.size());
  }

  void compareStep() {
    m_oracle.step();
    const StepResult result = m_world.step();
    ASSERT_EQ(test::toVector(result.pairs), m_oracle.pairs);
    ASSERT_EQ(test::toVector(result.began), m_oracle.began);
    ASSERT_EQ(test::toVector(result.persisted), m_oracle.persisted);
    ASSERT_EQ(test::toVector(result.ended), m_oracle.ended);
    compareEachWorld();
  }

  void compareEachWorld() {
    const bool looks = chance(0.5);  // Lists are grouped only for those who ask.
    for (auto& [number, oracle] : m_each) {
      oracle.boxes = m_oracle.boxes;
      oracle.step();
      if (!looks) continue;
      const StepResult result = m_world.result(number);
      ASSERT_EQ(test::toVector(result.pairs), oracle.pairs) << "world " << number;
      ASSERT_EQ(test::toVector(result.began), oracle.began) << "world " << number;
      ASSERT_EQ(test::toVector(result.persisted), oracle.persisted) << "world " << number;
      ASSERT_EQ(test::toVector(result.ended), oracle.ended) << "world " << number;
    }
  }

  QueryFilter anyFilter() {
    QueryFilter filter;
    if (m_life.worlds != 0 && chance(0.7)) filter.world = anyWorld(below(m_life.worlds + 1));
    if (chance(0.5)) return filter;
    filter.mask = static_cast<std::uint32_t>(below(8));
    filter.category = static_cast<std::uint32_t>(1 + below(7));
    filter.staticBoxes = chance(0.7);
    filter.dynamicBoxes = chance(0.7);
    return filter;
  }

  Ray anyRay() {
    Ray ray;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = m_side * (1.4 * uniform() - 0.2);
      ray.direction[axis] = chance(0.2) ? 0.0 : uniform() - 0.5;
    }
    if (chance(0.5)) ray.length = 4 * m_side * uniform();
    return ray;
  }

  void compareQueries() {
    const QueryFilter filter = anyFilter();
    std::vector<Box> boxes;
    std::vector<Ray> rays;
    std::vector<BoxSweep> sweeps;
    std::vector<std::array<double, 3>> points;
    for (int i = 0; i < 20; ++i) {
      boxes.push_back(anyBox());
      rays.push_back(anyRay());
      const Ray way = anyRay();
      sweeps.push_back({anyBox(), way.direction, way.length});
      points.push_back(anyRay().origin);
    }
    compareBoxes(boxes, filter);
    compareRays(rays, filter);
    compareSweeps(sweeps, filter);
    compareNearest(points, filter);
    compareNearest(boxes, filter);
    compareVisits(boxes, filter);
  }

  void compareBoxes(const std::vector<Box>& boxes, const QueryFilter& filter) {
    const ResultLists<BoxId> lists = m_world.findOverlapping(boxes, filter);
    ASSERT_EQ(lists.size(), boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ASSERT_EQ(std::vector<BoxId>(lists[i].begin(), lists[i].end()), m_oracle.overlapping(boxes[i], filter));
    }
  }

  void compareRays(const std::vector<Ray>& rays, const QueryFilter& filter) {
    const ResultLists<SweepHit> lists = m_world.findAll(rays, filter);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const BoxSweep point{{rays[i].origin, rays[i].origin}, rays[i].direction, rays[i].length};
      const std::vector<SweepHit> expected = m_oracle.along(point, filter);
      ASSERT_EQ(std::vector<SweepHit>(lists[i].begin(), lists[i].end()), expected);
    }
    for (const Ray& ray : rays) {
      const std::vector<SweepHit> expected =
          m_oracle.along({{ray.origin, ray.origin}, ray.direction, ray.length}, filter);
      ASSERT_EQ(m_world.findFirst(ray, filter), expected.empty() ? SweepHit{} : expected.front());
    }
  }

  void compareSweeps(const std::vector<BoxSweep>& sweeps, const QueryFilter& filter) {
    std::vector<SweepHit> first(sweeps.size());
    m_world.findFirst(sweeps, first, filter);
    const ResultLists<SweepHit> lists = m_world.findAll(sweeps, filter);
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      const std::vector<SweepHit> expected = m_oracle.along(sweeps[i], filter);
      ASSERT_EQ(std::vector<SweepHit>(lists[i].begin(), lists[i].end()), expected);
      ASSERT_EQ(first[i], expected.empty() ? SweepHit{} : expected.front());
    }
  }

  /// To points or boxes.
  template <class Query>
  void compareNearest(const std::vector<Query>& queries, const QueryFilter& filter) {
    const std::size_t count = below(12);
    const ResultLists<Neighbor> lists = m_world.findNearest(queries, count, filter);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const std::vector<Neighbor> expected = m_oracle.nearest(queries[i], count, filter);
      ASSERT_EQ(std::vector<Neighbor>(lists[i].begin(), lists[i].end()), expected);
    }
  }

  void compareVisits(const std::vector<Box>& boxes, const QueryFilter& filter) {
    for (const Box& box : boxes) {
      const std::vector<Neighbor> all = m_oracle.nearest(box, m_oracle.boxes.size(), filter);
      const double distance = all.empty() ? 1.0 : all[below(all.size())].distance;
      std::vector<BoxId> expected;
      for (const Neighbor& near : all) {
        if (near.distance <= distance) expected.push_back(near.id);
      }
      std::vector<BoxId> visited;
      m_world.visitNear(
          box, distance, [&](BoxId id) { return visited.push_back(id), distance; }, filter);
      std::sort(expected.begin(), expected.end());
      std::sort(visited.begin(), visited.end());
      ASSERT_TRUE(std::includes(visited.begin(), visited.end(), expected.begin(), expected.end()));
      ASSERT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
      ASSERT_LE(visited.size(), all.size());
    }
  }

  Life m_life;
  World m_world;
  test::WorldOracle m_oracle;
  std::map<std::uint32_t, test::WorldOracle> m_each;  ///< By world number.
  std::mt19937 m_random;
  double m_side = 1.0;
};

Life anyLife() {
  Life life;
  life.boxes = *rc::gen::element<std::size_t>(0, 1, 3, 20, 100, 400);
  life.steps = test::repeats<std::size_t>(life.boxes > 100 ? 12 : 40);
  life.movedShare = *rc::gen::element(1.0, 0.5, 0.1, 0.02);
  life.staticShare = *rc::gen::element(0.0, 0.0, 0.5, 0.9, 1.0);
  life.float32 = *rc::gen::arbitrary<bool>();
  life.margins = *rc::gen::arbitrary<bool>();
  life.filters = *rc::gen::arbitrary<bool>();
  life.jumps = *rc::gen::arbitrary<bool>();
  life.extremes = *rc::gen::element(false, false, true);
  life.worlds = *rc::gen::element<std::size_t>(0, 0, 1, 2, 5, 40);
  life.sharedShare = *rc::gen::element(0.0, 0.02, 0.2);
  life.resets = life.worlds > 1 && *rc::gen::arbitrary<bool>();
  life.distance = *rc::gen::element(0.0, 0.0, 0.25, -0.25);
  life.seed = *rc::gen::arbitrary<std::uint32_t>();
  return life;
}

RC_GTEST_PROP(WorldProperty, AnyLifeGivesTheOraclesListsAndQueries, ()) {
  const Life life = anyLife();
  RC_LOG() << life << '\n';
  WorldOptions options;
  options.distance = life.distance;
  options.order = *rc::gen::element(Order::ByFirst, Order::BySecond);
  Lives(life, options).lead();
  RC_ASSERT(!::testing::Test::HasFailure());
}

class WorldInstructionSet : public ::testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, WorldInstructionSet,
                         ::testing::ValuesIn(instructionSets().begin(), instructionSets().end()));

TEST_P(WorldInstructionSet, GivesTheOraclesListsOfWorldsLargeAndSmall) {
  Life life;
  life.sharedShare = 0.02;
  for (const bool float32 : {true, false}) {
    for (const std::size_t worlds : {std::size_t{2}, std::size_t{30}}) {
      life.float32 = float32;
      life.worlds = worlds;
      life.boxes = worlds == 2 ? 1200 : 600;
      life.steps = test::kIsSanitized ? 3 : 8;
      life.staticShare = float32 ? 0.0 : 0.3;
      life.seed = static_cast<std::uint32_t>(worlds);
      WorldOptions options;
      options.instructionSet = GetParam();
      Lives(life, options).lead();
    }
  }
}

TEST_P(WorldInstructionSet, GivesTheOraclesListsAndQueries) {
  Life life;
  life.boxes = 800;
  if (test::kIsSanitized) life.steps = 8;
  life.staticShare = 0.3;
  life.seed = 7;
  for (const double share : {1.0, 0.05}) {
    life.movedShare = share;
    WorldOptions options;
    options.instructionSet = GetParam();
    Lives(life, options).lead();
  }
}

}  // namespace
}  // namespace allpairs
