// SPDX-License-Identifier: MIT
// Each allocation in the life of a world fails once: boxes are as they were, and the next step tells what has changed
// since the last one that gave a result.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "CompareStep.h"
#include "WorldOracle.h"
#include "allpairs/World.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"
#include "support/PoolExecutor.h"

namespace allpairs {
namespace {

constexpr std::size_t kBoxes = 300;

/// A world and what it must be.
class Twins {
 public:
  explicit Twins(const WorldOptions& options = {}) : world(options) { oracle.distance = options.distance; }

  /// Among the worlds, if there are several.
  void add(const std::vector<Box>& boxes, const BoxProperties& properties) {
    std::vector<BoxProperties> each(boxes.size(), properties);
    for (std::size_t i = 0; i < boxes.size() && worlds > 1; ++i) each[i].world = static_cast<std::uint32_t>(i % worlds);
    std::vector<BoxId> added(boxes.size());
    world.add(boxes, each, added);
    noteAdded(added, boxes, properties);
    for (std::size_t i = 0; i < added.size(); ++i) oracle.boxes[added[i]].properties = each[i];
  }

  void noteAdded(const std::vector<BoxId>& added, const std::vector<Box>& boxes, const BoxProperties& properties) {
    for (std::size_t i = 0; i < added.size(); ++i) {
      ASSERT_FALSE(oracle.boxes.contains(added[i]));
      oracle.boxes[added[i]] = {boxes[i], properties};
    }
    ids.insert(ids.end(), added.begin(), added.end());
  }

  void step() {
    static_cast<void>(world.step());
    oracle.step();
  }

  /// The world has the oracle's boxes and no others.
  void compareBoxes() const {
    ASSERT_EQ(world.size(), oracle.boxes.size());
    std::size_t there = 0;
    for (BoxId id = 0; id < world.idBound(); ++id) there += world.contains(id) ? 1U : 0U;
    ASSERT_EQ(there, oracle.boxes.size());
    for (const auto& [id, entry] : oracle.boxes) {
      ASSERT_TRUE(world.contains(id));
      ASSERT_EQ(world.box(id), entry.box) << "box " << id;
      ASSERT_EQ(world.properties(id), entry.properties) << "box " << id;
    }
  }

  void compareStep() { test::compareStep(world, oracle); }

  void compareQueries() {
    const Box query = test::cube(1, 1, 1, 2.5);
    const std::vector<BoxId> met = world.findOverlapping(query);
    ASSERT_EQ(std::vector<BoxId>(met.begin(), met.end()), oracle.overlapping(query, {}));
    const std::vector<Neighbor> near = world.findNearest({2, 2, 2}, 9);
    ASSERT_EQ(std::vector<Neighbor>(near.begin(), near.end()), oracle.nearest(Box{{2, 2, 2}, {2, 2, 2}}, 9, {}));
  }

  World world;
  std::size_t worlds = 1;
  test::WorldOracle oracle;
  std::vector<BoxId> ids;
};

std::vector<Box> someBoxes(std::size_t n, unsigned seed) { return test::toDouble(test::randomBoxes(n, seed)); }

/// Not held exactly by float32.
std::vector<Box> fineBoxes(std::size_t n, unsigned seed) {
  std::vector<Box> boxes = someBoxes(n, seed);
  for (Box& box : boxes) box.min[1] -= 1e-10;
  return boxes;
}

BoxProperties fixed() {
  BoxProperties properties;
  properties.isStatic = true;
  return properties;
}

/// A world some steps old, with what has changed since the last one.
void prepare(Twins& twins) {
  twins.add(someBoxes(kBoxes, 61), {});
  twins.add(someBoxes(kBoxes / 3, 62), fixed());
  twins.step();
  const std::vector<Box> moved = someBoxes(20, 63);
  const std::vector<BoxId> few(twins.ids.begin(), twins.ids.begin() + 20);
  twins.world.move(few, moved);
  for (std::size_t i = 0; i < few.size(); ++i) twins.oracle.boxes[few[i]].box = moved[i];
  for (std::size_t i = 30; i < 35; ++i) {
    twins.world.remove(twins.ids[i]);
    twins.oracle.boxes.erase(twins.ids[i]);
  }
  twins.ids.erase(twins.ids.begin() + 30, twins.ids.begin() + 35);
}

/// Runs a change with each allocation failing in it. `change` changes the world and `note` the oracle, if it passed.
void check(const std::function<void(Twins&)>& change, const std::function<void(Twins&)>& note,
           const WorldOptions& options = {}) {
  for (const bool midStep : {true, false}) {
    test::failEachAllocation([&](test::Fault& fault) {
      Twins twins(options);
      prepare(twins);
      if (!midStep) twins.step();
      if (fault.during([&] { change(twins); })) note(twins);
      twins.compareBoxes();
      twins.compareQueries();
      twins.compareStep();
      change(twins);  // with memory it passes
      note(twins);
      twins.compareBoxes();
      twins.compareStep();
    });
  }
}

TEST(FailedWorldAllocation, OfAddingBoxesAddsNone) {
  const std::vector<Box> boxes = fineBoxes(50, 64);
  BoxProperties properties;
  properties.margin = 0.25;
  std::vector<BoxId> added(boxes.size());
  check(
      [&](Twins& twins) {
        twins.world.add(boxes, {&properties, 1}, added);
      },
      [&](Twins& twins) { twins.noteAdded(added, boxes, properties); });
}

TEST(FailedWorldAllocation, OfAddingOneBoxByOneAddsTheOnesBefore) {
  const std::vector<Box> boxes = fineBoxes(40, 65);
  std::vector<BoxId> added;
  added.reserve(boxes.size());
  const auto note = [&](Twins& twins) {
    twins.noteAdded(added, {boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(added.size())}, {});
  };
  test::failEachAllocation([&](test::Fault& fault) {
    Twins twins;
    added.clear();
    static_cast<void>(fault.during([&] {
      for (const Box& box : boxes) added.push_back(twins.world.add(box));
    }));
    note(twins);
    twins.compareBoxes();
    twins.compareStep();
  });
}

/// It promises not to throw, and there is nothing to release.
TEST(FailedWorldAllocation, AWorldWithoutBoxesAllocatesNothingToShrink) {
  test::Fault fault(1, test::Failing::Onwards);
  World world;
  EXPECT_TRUE(fault.during([&] { world.shrink(); }));
  EXPECT_FALSE(fault.happened());
}

/// Margins that have moved to other memory before the allocation that fails are read there.
TEST(FailedWorldAllocation, OfAddingBoxesWithMarginsLeavesTheMarginsOfOthers) {
  const std::vector<Box> boxes = someBoxes(60, 67);
  const std::vector<Box> more = someBoxes(200, 68);
  const std::vector<Box> moved = someBoxes(60, 69);
  BoxProperties wide;
  wide.margin = 0.125;
  std::vector<BoxId> added(more.size());
  test::failEachAllocation([&](test::Fault& fault) {
    Twins twins;
    twins.add(boxes, wide);
    twins.world.shrink();
    twins.step();
    const bool passed = fault.during([&] { twins.world.add(more, {&wide, 1}, added); });
    // Likely to be where the margins were.
    const std::vector<std::vector<double>> others(4, std::vector<double>(boxes.size(), 100.0));
    if (passed) twins.noteAdded(added, more, wide);
    twins.world.move(std::span<const BoxId>(twins.ids).first(moved.size()), moved);
    for (std::size_t i = 0; i < moved.size(); ++i) twins.oracle.boxes[twins.ids[i]].box = moved[i];
    twins.compareStep();
  });
}

TEST(FailedWorldAllocation, OfMovingBoxesMovesNone) {
  const std::vector<Box> boxes = fineBoxes(120, 66);
  const auto some = [](Twins& twins) { return std::span<const BoxId>(twins.ids).first(120); };
  check([&](Twins& twins) { twins.world.move(some(twins), boxes); },
        [&](Twins& twins) {
          for (std::size_t i = 0; i < boxes.size(); ++i) twins.oracle.boxes[twins.ids[i]].box = boxes[i];
        });
}

TEST(FailedWorldAllocation, OfMovingOneBoxDoesNotMoveIt) {
  const Box box = fineBoxes(1, 66)[0];
  check([&](Twins& twins) { twins.world.move(twins.ids[3], box); },
        [&](Twins& twins) { twins.oracle.boxes[twins.ids[3]].box = box; });
}

TEST(FailedWorldAllocation, OfSweptBoxesMovesNone) {
  const std::vector<Box> starts = fineBoxes(60, 67);
  const std::vector<double> velocities(3 * starts.size(), 0.5);
  const auto some = [](Twins& twins) { return std::span<const BoxId>(twins.ids).first(60); };
  check([&](Twins& twins) { twins.world.moveSwept(some(twins), starts, velocities, 0.5); },
        [&](Twins& twins) {
          for (std::size_t i = 0; i < starts.size(); ++i) {
            Box swept = starts[i];
            for (double& bound : swept.max) bound += 0.25;
            twins.oracle.boxes[twins.ids[i]].box = swept;
          }
        });
}

TEST(FailedWorldAllocation, OfChangingPropertiesChangesNone) {
  BoxProperties properties;
  properties.margin = 0.125;
  properties.isStatic = true;
  properties.group = 3;
  const auto some = [](Twins& twins) { return std::span<const BoxId>(twins.ids).subspan(5, 40); };
  check(
      [&](Twins& twins) {
        twins.world.setProperties(some(twins), {&properties, 1});
      },
      [&](Twins& twins) {
        for (const BoxId id : some(twins)) twins.oracle.boxes[id].properties = properties;
      });
}

TEST(FailedWorldAllocation, OfRemovingBoxesRemovesNone) {
  const auto last = [](Twins& twins) { return std::span<const BoxId>(twins.ids).last(70); };
  check([&](Twins& twins) { twins.world.remove(last(twins)); },
        [&](Twins& twins) {
          for (const BoxId id : last(twins)) twins.oracle.boxes.erase(id);
          twins.ids.resize(twins.ids.size() - 70);
        });
}

TEST(FailedWorldAllocation, OfClearingRemovesNone) {
  test::failEachAllocation([](test::Fault& fault) {
    Twins twins;
    prepare(twins);
    if (fault.during([&] { twins.world.clear(); })) twins.oracle.boxes.clear();
    twins.compareBoxes();
    twins.compareStep();
    twins.add(someBoxes(30, 68), {});
    twins.compareStep();
  });
}

TEST(FailedWorldAllocation, OfReservingChangesNothing) {
  test::failEachAllocation([](test::Fault& fault) {
    Twins twins;
    prepare(twins);
    static_cast<void>(fault.during([&] { twins.world.reserve(10 * kBoxes); }));
    twins.compareBoxes();
    twins.compareStep();
  });
}

/// What a step may find: nothing but itself, a few boxes that moved, or all.
void changeForStep(Twins& twins, std::size_t moved) {
  const std::vector<Box> boxes = someBoxes(moved, 69);
  const std::span<const BoxId> some = std::span<const BoxId>(twins.ids).first(moved);
  twins.world.move(some, boxes);
  for (std::size_t i = 0; i < moved; ++i) twins.oracle.boxes[some[i]].box = boxes[i];
}

void checkSteps(const WorldOptions& options, std::size_t worlds = 1) {
  for (const std::size_t moved : {0U, 30U, 250U}) {
    SCOPED_TRACE(std::to_string(moved) + " more boxes moved");
    test::failEachAllocation([&](test::Fault& fault) {
      Twins twins(options);
      twins.worlds = worlds;
      prepare(twins);
      changeForStep(twins, moved);
      if (fault.during([&] { static_cast<void>(twins.world.step()); })) {
        twins.oracle.step();
      } else {
        // The result is that of the last step that gave one, with no changes.
        const StepResult& result = twins.world.result();
        ASSERT_EQ(test::toVector(result.pairs), twins.oracle.pairs);
        ASSERT_EQ(test::toVector(result.persisted), twins.oracle.pairs);
        ASSERT_TRUE(result.began.empty() && result.ended.empty());
      }
      twins.compareBoxes();
      twins.compareStep();
      changeForStep(twins, 40);
      twins.compareQueries();
      twins.compareStep();
    });
  }
}

TEST(FailedWorldAllocation, OfAStepIsMadeUpForByTheNextStep) { checkSteps({}); }

/// So many pairs begin that the list moves to other memory before memory for their order is asked for.
TEST(FailedWorldAllocation, OfAStepThatFindsManyPairsLeavesTheListsOfTheLastStep) {
  constexpr std::size_t kInRow = 20000;
  std::vector<Box> row;
  for (std::size_t i = 0; i < kInRow; ++i) row.push_back(test::cube(3.0 * static_cast<double>(i), 0, 0, 1));
  row.push_back(test::cube(0.5, 0, 0, 1));
  test::failEachAllocation([&](test::Fault& fault) {
    World world;
    std::vector<BoxId> ids(row.size());
    world.add(row, {}, ids);
    const std::vector<Pair> before = test::toVector(world.step().pairs);
    for (std::size_t i = 0; i < kInRow / 34; ++i) world.move(ids[1000 + i], Box{{0, 0, 0}, {60, 1, 1}});
    if (fault.during([&] { static_cast<void>(world.step()); })) return;
    ASSERT_EQ(test::toVector(world.result().pairs), before);
    ASSERT_EQ(test::toVector(world.result().persisted), before);
    // One list: what is read in memory that was freed may still look right.
    ASSERT_EQ(world.result().persisted.data(), world.result().pairs.data());
  });
}

TEST(FailedWorldAllocation, OfAStepOnThreadsIsMadeUpForByTheNextStep) {
  test::PoolExecutor threads(3);
  WorldOptions options;
  options.executor = &threads;
  options.distance = 0.125;
  checkSteps(options);
}

/// Worlds small and large, the latter because there are more boxes of double.
TEST(FailedWorldAllocation, OfAStepOfManyWorldsIsMadeUpForByTheNextStep) {
  checkSteps({}, 10);
  WorldOptions options;
  options.distance = 0.125;
  checkSteps(options, 2);
}

TEST(FailedWorldAllocation, OfTheFirstWorldNumberChangesNothing) {
  BoxProperties properties;
  properties.world = 3;
  const auto some = [](Twins& twins) { return std::span<const BoxId>(twins.ids).subspan(5, 100); };
  check(
      [&](Twins& twins) {
        twins.world.setProperties(some(twins), {&properties, 1});
      },
      [&](Twins& twins) {
        for (const BoxId id : some(twins)) twins.oracle.boxes[id].properties = properties;
      });
}

TEST(FailedWorldAllocation, OfTheListsOfAWorldChangesNone) {
  test::failEachAllocation([](test::Fault& fault) {
    Twins twins;
    twins.worlds = 3;
    prepare(twins);
    twins.step();
    static_cast<void>(fault.during([&] { static_cast<void>(twins.world.result(1)); }));
    test::WorldOracle one = twins.oracle;
    one.only = 1;
    one.pairs.clear();
    one.step();
    ASSERT_EQ(test::toVector(twins.world.result(1).pairs), one.pairs);
    twins.compareStep();
  });
}

TEST(FailedWorldAllocation, OfTheFirstStepIsMadeUpForByTheNextStep) {
  test::failEachAllocation([](test::Fault& fault) {
    Twins twins;
    twins.add(someBoxes(kBoxes, 70), {});
    if (fault.during([&] { static_cast<void>(twins.world.step()); })) twins.oracle.step();
    twins.compareStep();
  });
}

TEST(FailedWorldAllocation, OfAStepThatRebuildsIsMadeUpForByTheNextStep) {
  test::failEachAllocation([](test::Fault& fault) {
    Twins twins;
    prepare(twins);
    twins.step();
    twins.add(someBoxes(2 * kBoxes, 71), {});  // more than there is room for
    if (fault.during([&] { static_cast<void>(twins.world.step()); })) twins.oracle.step();
    twins.compareStep();
    changeForStep(twins, 40);
    twins.compareStep();
  });
}

TEST(FailedWorldAllocation, OfQueriesChangesNoBoxAndNoPair) {
  const std::vector<Box> queries = someBoxes(100, 72);
  std::vector<BoxSweep> sweeps;
  std::vector<Ray> rays;
  std::vector<std::array<double, 3>> points;
  for (const Box& box : queries) {
    sweeps.push_back({box, {1, 0.5, -0.25}, 3.0});
    rays.push_back({box.min, {0.5, 1, 0.25}, 5.0});
    points.push_back(box.max);
  }
  std::vector<SweepHit> hits(queries.size());
  const std::vector<std::function<void(World&)>> each{
      [&](World& world) { static_cast<void>(world.findOverlapping(queries)); },
      [&](World& world) { world.findFirst(std::span<const BoxSweep>(sweeps), hits); },
      [&](World& world) { world.findFirst(std::span<const Ray>(rays), hits); },
      [&](World& world) { static_cast<void>(world.findAll(std::span<const BoxSweep>(sweeps))); },
      [&](World& world) { static_cast<void>(world.findAll(std::span<const Ray>(rays))); },
      [&](World& world) { static_cast<void>(world.findNearest(points, 5)); },
      [&](World& world) { static_cast<void>(world.findNearest(queries, 5)); }};
  for (std::size_t k = 0; k < 2 * each.size(); ++k) {
    const auto& query = each[k / 2];
    test::failEachAllocation([&](test::Fault& fault) {
      Twins twins;
      twins.worlds = k % 2 == 0 ? 1 : 4;
      prepare(twins);
      static_cast<void>(fault.during([&] { query(twins.world); }));
      twins.compareBoxes();
      twins.compareQueries();
      twins.compareStep();
    });
  }
}

TEST(FailedWorldAllocation, OfFindBetweenChangesNeitherWorld) {
  test::failEachAllocation([](test::Fault& fault) {
    Twins twins;
    Twins others;
    prepare(twins);
    prepare(others);
    World fresh;
    static_cast<void>(fault.during([&] { static_cast<void>(twins.world.findBetween(others.world)); }));
    const std::vector<Pair> found = test::toVector(twins.world.findBetween(others.world));
    Twins freshTwins;
    Twins freshOthers;
    prepare(freshTwins);
    prepare(freshOthers);
    ASSERT_EQ(found, test::toVector(freshTwins.world.findBetween(freshOthers.world)));
    twins.compareBoxes();
    twins.compareStep();
    others.compareStep();
  });
}

TEST(FailedWorldAllocation, WhileAWorldIsMadeLeaksNothing) {
  test::failEachAllocation([](test::Fault& fault) { static_cast<void>(fault.during([] { const World world; })); });
}

}  // namespace
}  // namespace allpairs
