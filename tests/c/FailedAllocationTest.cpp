// SPDX-License-Identifier: MIT
// Each allocation of each function of the interface for C fails once: a status, a message, and all can be used on.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "allpairs.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"

namespace allpairs {
namespace {

constexpr std::size_t kBoxes = 300;

std::vector<double> rowsOf(std::size_t count, unsigned seed) {
  std::vector<double> rows;
  for (const Box& box : test::toDouble(test::randomBoxes(count, seed))) {
    rows.insert(rows.end(), box.min.begin(), box.min.end());
    rows.insert(rows.end(), box.max.begin(), box.max.end());
    rows.back() += 1e-10;  // no float32
  }
  return rows;
}

/// Handles of each kind, over boxes that outlive them.
class Handles {
 public:
  Handles() {
    expectOk(allpairs_set_create_f64(rows().data(), kBoxes, &set));
    expectOk(allpairs_set_create_f64(otherRows().data(), kBoxes, &other));
    allpairs_options options = allpairs_default_options();
    options.strategy = ALLPAIRS_BVH;
    expectOk(allpairs_search_create(&options, &search));
    expectOk(allpairs_world_create(nullptr, &world));
    ids.resize(kBoxes);
    expectOk(allpairs_world_add(world, set, nullptr, ids.data()));
    allpairs_step step;
    expectOk(allpairs_world_step(world, &step));
    const allpairs_mesh mesh{kVertices, triangles().data(), triangles().size() / 3};
    expectOk(allpairs_elements_create(&mesh, 1, nullptr, &elements));
    expectOk(allpairs_elements_move_f64(elements, 0, rows().data(), otherRows().data()));
  }
  ~Handles() {
    allpairs_elements_destroy(elements);
    allpairs_world_destroy(world);
    allpairs_search_destroy(search);
    allpairs_set_destroy(other);
    allpairs_set_destroy(set);
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  Handles(Handles&&) = delete;
  Handles& operator=(Handles&&) = delete;

  static constexpr std::size_t kVertices = 60;

  static const std::vector<double>& rows() {
    static const std::vector<double> kRows = rowsOf(kBoxes, 95);
    return kRows;
  }
  static const std::vector<double>& otherRows() {
    static const std::vector<double> kRows = rowsOf(kBoxes, 96);
    return kRows;
  }
  static const std::vector<std::uint32_t>& triangles() {
    static const std::vector<std::uint32_t> kTriangles = [] {
      std::vector<std::uint32_t> triangles;
      for (std::uint32_t i = 2; i < kVertices; ++i) triangles.insert(triangles.end(), {i - 2, i - 1, i});
      return triangles;
    }();
    return kTriangles;
  }

  [[nodiscard]] allpairs_ids some() const { return {ids.data(), 50}; }

  static void expectOk(allpairs_status status) { ASSERT_EQ(status, ALLPAIRS_OK) << allpairs_error_message(); }

  /// What each kind of handle gives.
  std::vector<Pair> results() {
    std::vector<Pair> all;
    const auto keep = [&all](allpairs_pairs pairs) {
      for (std::size_t i = 0; i < pairs.count; ++i) all.push_back({pairs.data[i].first, pairs.data[i].second});
    };
    allpairs_pairs pairs;
    expectOk(allpairs_find(search, set, &pairs));
    keep(pairs);
    expectOk(allpairs_find_between(search, set, other, &pairs));
    keep(pairs);
    allpairs_step step;
    expectOk(allpairs_world_step(world, &step));
    keep(step.pairs);
    expectOk(allpairs_elements_find(elements, ALLPAIRS_EDGE_EDGE, &pairs));
    keep(pairs);
    return all;
  }

  allpairs_set* set = nullptr;
  allpairs_set* other = nullptr;
  allpairs_search* search = nullptr;
  allpairs_world* world = nullptr;
  allpairs_elements* elements = nullptr;
  std::vector<std::uint32_t> ids;
};

/// A call of the interface, and whether it changes what handles give afterwards, as the same call after it does.
using Call = std::function<allpairs_status(Handles&)>;

void check(const Call& call) {
  std::vector<Pair> unchanged;
  std::vector<Pair> changed;
  {
    Handles fresh;
    unchanged = fresh.results();
    Handles::expectOk(call(fresh));
    changed = fresh.results();
  }
  test::failEachAllocation([&](test::Fault& fault) {
    Handles handles;
    allpairs_status status = ALLPAIRS_OK;
    ASSERT_TRUE(fault.during([&] { status = call(handles); }));  // no exception leaves the library
    if (status != ALLPAIRS_OK) {
      ASSERT_EQ(status, ALLPAIRS_OUT_OF_MEMORY);
      ASSERT_STREQ(allpairs_error_message(), "out of memory");
    }
    ASSERT_EQ(handles.results(), status == ALLPAIRS_OK ? changed : unchanged);
    ASSERT_EQ(call(handles), ALLPAIRS_OK) << allpairs_error_message();
  });
}

bool takeAll(void*, allpairs_pairs) { return true; }

/// What is made once and stays: the boxes of this test, what a first search leaves, the note of a thread's first
/// failure.
class MadeOnce : public ::testing::Environment {
 public:
  void SetUp() override {
    Handles handles;
    static_cast<void>(handles.results());
    EXPECT_NE(allpairs_find(nullptr, nullptr, nullptr), ALLPAIRS_OK);
  }
};
const ::testing::Environment* const kMadeOnce = ::testing::AddGlobalTestEnvironment(new MadeOnce);  // which it owns

TEST(FailedAllocationInC, OfSearches) {
  allpairs_pairs pairs;
  std::uint64_t count = 0;
  const allpairs_visitor visitor{takeAll, nullptr, 0};
  check([&](Handles& h) { return allpairs_find(h.search, h.set, &pairs); });
  check([&](Handles& h) { return allpairs_find_between(h.search, h.set, h.other, &pairs); });
  std::vector<allpairs_pair> memory(100000);
  allpairs_pair_memory into{memory.data(), memory.size(), 0};
  check([&](Handles& h) { return allpairs_find_into(h.search, h.set, &into); });
  allpairs_rows rows;
  check([&](Handles& h) { return allpairs_find_neighbors(h.search, h.set, ALLPAIRS_FULL_ROWS, &rows); });
  check([&](Handles& h) { return allpairs_find_neighbors_between(h.search, h.set, h.other, &rows); });
  check([&](Handles& h) { return allpairs_count(h.search, h.set, &count); });
  check([&](Handles& h) { return allpairs_count_between(h.search, h.set, h.other, &count); });
  check([&](Handles& h) { return allpairs_stream(h.search, h.set, visitor); });
  check([&](Handles& h) { return allpairs_stream_between(h.search, h.set, h.other, visitor); });
}

TEST(FailedAllocationInC, OfWorldsChanges) {
  std::vector<std::uint32_t> added(kBoxes);
  std::vector<allpairs_properties> properties(50, allpairs_default_properties());
  for (allpairs_properties& p : properties) p.margin = 0.25;
  allpairs_step step;
  check([&](Handles& h) { return allpairs_world_add(h.world, h.other, nullptr, added.data()); });
  const std::vector<allpairs_properties> each(kBoxes, properties[0]);
  check([&](Handles& h) { return allpairs_world_add_each(h.world, h.other, each.data(), added.data()); });
  check([&](Handles& h) { return allpairs_world_reserve(h.world, 5 * kBoxes); });
  check([&](Handles& h) { return allpairs_world_move_swept(h.world, {h.ids.data(), kBoxes}, h.set, h.other); });
  const allpairs_velocities velocities{Handles::otherRows().data(), 0.1};
  check([&](Handles& h) { return allpairs_world_move_swept_by(h.world, {h.ids.data(), kBoxes}, h.set, &velocities); });
  check([&](Handles& h) { return allpairs_world_set_properties(h.world, h.some(), properties.data()); });
  check([&](Handles& h) { return allpairs_world_clear(h.world); });
  check([&](Handles& h) {
    const allpairs_status status = allpairs_world_move(h.world, {h.ids.data(), kBoxes}, h.set);
    return status == ALLPAIRS_OK ? allpairs_world_step(h.world, &step) : status;
  });
}

/// New settings are taken as a whole or not at all.
TEST(FailedAllocationInC, OfSettings) {
  allpairs_options options = allpairs_default_options();
  options.distance = 0.5;
  options.stop = [](void*) { return false; };
  check([&](Handles& h) { return allpairs_search_set_options(h.search, &options); });
}

TEST(FailedAllocationInC, OfRemovingBoxes) {
  std::vector<double> bounds(6);
  test::failEachAllocation([&](test::Fault& fault) {
    Handles handles;
    allpairs_status status = ALLPAIRS_OK;
    ASSERT_TRUE(fault.during([&] { status = allpairs_world_remove(handles.world, handles.some()); }));
    ASSERT_EQ(allpairs_world_size(handles.world), status == ALLPAIRS_OK ? kBoxes - 50 : kBoxes);
    ASSERT_EQ(allpairs_world_contains(handles.world, handles.ids[3]), status != ALLPAIRS_OK);
    allpairs_step step;
    ASSERT_EQ(allpairs_world_step(handles.world, &step), ALLPAIRS_OK);
  });
}

TEST(FailedAllocationInC, OfQueries) {
  const double box[6] = {1, 1, 1, 3, 3, 3};
  const allpairs_ray ray{{0, 0, 0}, {1, 1, 1}, 9};
  const allpairs_sweep sweep{{0, 0, 0, 1, 1, 1}, {1, 1, 1}, 9};
  const allpairs_nearest nearest{{1, 1, 1}, 5};
  const std::vector<allpairs_ray> rays(100, ray);
  const std::vector<allpairs_sweep> sweeps(100, sweep);
  const std::vector<double> points(300, 1.0);
  const allpairs_nearest_many nearestMany{points.data(), 100, 5};
  std::vector<allpairs_hit> hitsOfMany(100);
  allpairs_ids ids;
  allpairs_hits hits;
  allpairs_neighbors neighbors;
  allpairs_id_lists idLists;
  allpairs_hit_lists hitLists;
  allpairs_neighbor_lists neighborLists;
  allpairs_pairs pairs;
  check([&](Handles& h) { return allpairs_world_find_overlapping(h.world, box, nullptr, &ids); });
  check([&](Handles& h) { return allpairs_world_find_all(h.world, &ray, nullptr, &hits); });
  check([&](Handles& h) { return allpairs_world_sweep_all(h.world, &sweep, nullptr, &hits); });
  check([&](Handles& h) { return allpairs_world_find_nearest(h.world, &nearest, nullptr, &neighbors); });
  check([&](Handles& h) { return allpairs_world_find_overlapping_many(h.world, h.other, nullptr, &idLists); });
  check([&](Handles& h) {
    return allpairs_world_find_first_many(h.world, {rays.data(), 100}, nullptr, hitsOfMany.data());
  });
  check([&](Handles& h) { return allpairs_world_find_all_many(h.world, {rays.data(), 100}, nullptr, &hitLists); });
  check([&](Handles& h) {
    return allpairs_world_sweep_first_many(h.world, {sweeps.data(), 100}, nullptr, hitsOfMany.data());
  });
  check([&](Handles& h) { return allpairs_world_sweep_all_many(h.world, {sweeps.data(), 100}, nullptr, &hitLists); });
  check([&](Handles& h) { return allpairs_world_find_nearest_many(h.world, &nearestMany, nullptr, &neighborLists); });
  check([&](Handles& h) {
    const allpairs_nearest_to_boxes toBoxes{h.other, 5};
    return allpairs_world_find_nearest_to_boxes(h.world, &toBoxes, nullptr, &neighborLists);
  });
  check([&](Handles& h) { return allpairs_world_find_between(h.world, h.world, &pairs); });
}

TEST(FailedAllocationInC, OfElements) {
  allpairs_pairs pairs;
  std::uint64_t count = 0;
  const allpairs_visitor visitor{takeAll, nullptr, 0};
  for (const allpairs_candidates kind : {ALLPAIRS_VERTEX_FACE, ALLPAIRS_EDGE_EDGE, ALLPAIRS_FACE_FACE}) {
    check([&](Handles& h) { return allpairs_elements_find(h.elements, kind, &pairs); });
    check([&](Handles& h) { return allpairs_elements_count(h.elements, kind, &count); });
    check([&](Handles& h) { return allpairs_elements_stream(h.elements, kind, visitor); });
  }
}

/// Whatever makes a handle leaves null where it fails.
template <class Handle, class Create, class Destroy>
void checkCreation(const Create& create, const Destroy& destroy) {
  test::failEachAllocation([&](test::Fault& fault) {
    Handle* handle = nullptr;
    allpairs_status status = ALLPAIRS_OK;
    ASSERT_TRUE(fault.during([&] { status = create(&handle); }));
    ASSERT_EQ(status, handle == nullptr ? ALLPAIRS_OUT_OF_MEMORY : ALLPAIRS_OK);
    destroy(handle);
  });
}

TEST(FailedAllocationInC, OfHandles) {
  const allpairs_mesh mesh{Handles::kVertices, Handles::triangles().data(), Handles::triangles().size() / 3};
  checkCreation<allpairs_set>([](auto** h) { return allpairs_set_create_f64(Handles::rows().data(), kBoxes, h); },
                              allpairs_set_destroy);
  checkCreation<allpairs_search>([](auto** h) { return allpairs_search_create(nullptr, h); }, allpairs_search_destroy);
  checkCreation<allpairs_world>([](auto** h) { return allpairs_world_create(nullptr, h); }, allpairs_world_destroy);
  allpairs_options options = allpairs_default_options();
  options.stop = [](void*) { return false; };
  options.instruction_set = "SCALAR";
  checkCreation<allpairs_search>([&](auto** h) { return allpairs_search_create(&options, h); },
                                 allpairs_search_destroy);
  allpairs_world_options ofWorld{};
  ofWorld.struct_size = sizeof ofWorld;
  ofWorld.stop = options.stop;
  ofWorld.instruction_set = "SCALAR";
  checkCreation<allpairs_world>([&](auto** h) { return allpairs_world_create(&ofWorld, h); }, allpairs_world_destroy);
  checkCreation<allpairs_elements>([&](auto** h) { return allpairs_elements_create(&mesh, 1, nullptr, h); },
                                   allpairs_elements_destroy);
  allpairs_elements_options ofElements{};
  ofElements.struct_size = sizeof ofElements;
  ofElements.stop = options.stop;
  checkCreation<allpairs_elements>([&](auto** h) { return allpairs_elements_create(&mesh, 1, &ofElements, h); },
                                   allpairs_elements_destroy);
}

/// A callback of C can say no, or end a stream; in all else it can't end a call. Of its own handle it gets a status.
struct Context {
  Handles* handles;
  std::size_t refused = 0;
  std::size_t calls = 0;
  std::size_t stopAt = 0;
};

bool callBack(Context& context) {
  Handles& h = *context.handles;
  allpairs_pairs pairs;
  std::uint64_t count = 0;
  const allpairs_options options = allpairs_default_options();
  context.refused += allpairs_find(h.search, h.set, &pairs) == ALLPAIRS_INVALID_ARGUMENT ? 1U : 0U;
  context.refused += allpairs_count(h.search, h.set, &count) == ALLPAIRS_INVALID_ARGUMENT ? 1U : 0U;
  context.refused += allpairs_search_set_options(h.search, &options) == ALLPAIRS_INVALID_ARGUMENT ? 1U : 0U;
  EXPECT_NE(std::string(allpairs_error_message()).find("called by its own filter"), std::string::npos);
  allpairs_step step;
  EXPECT_EQ(allpairs_world_step(h.world, &step), ALLPAIRS_OK);  // another handle
  return ++context.calls != context.stopAt;
}

TEST(CallbackInC, OfASearchGetsAStatusFromItsOwnHandle) {
  Handles handles;
  Context context{&handles};
  allpairs_options options = allpairs_default_options();
  options.accept_context = &context;
  options.accept = [](void* c, std::uint32_t, std::uint32_t) { return callBack(*static_cast<Context*>(c)); };
  ASSERT_EQ(allpairs_search_set_options(handles.search, &options), ALLPAIRS_OK);
  allpairs_pairs pairs;
  ASSERT_EQ(allpairs_find(handles.search, handles.set, &pairs), ALLPAIRS_OK);
  EXPECT_GT(context.calls, 100U);
  EXPECT_EQ(pairs.count, context.calls);
  EXPECT_EQ(context.refused, 3 * context.calls);
}

TEST(CallbackInC, OfAStreamMayStopItAtEveryBatch) {
  Handles handles;
  allpairs_options options = allpairs_default_options();
  ASSERT_EQ(allpairs_search_set_options(handles.search, &options), ALLPAIRS_OK);
  const std::vector<Pair> wanted = handles.results();
  for (std::size_t stopAt = 1;; ++stopAt) {
    Context context{&handles, 0, 0, stopAt};
    const allpairs_visitor visitor{[](void* c, allpairs_pairs) { return callBack(*static_cast<Context*>(c)); },
                                   &context, 16};
    const allpairs_status status = allpairs_stream(handles.search, handles.set, visitor);
    EXPECT_EQ(context.refused, 3 * context.calls);
    ASSERT_EQ(handles.results(), wanted);
    if (status == ALLPAIRS_OK) {
      EXPECT_GT(context.calls, 5U);
      break;
    }
    ASSERT_EQ(status, ALLPAIRS_STOPPED);
    ASSERT_EQ(context.calls, stopAt);
  }
}

TEST(CallbackInC, OfAWorldGetsAStatusFromItsOwnHandle) {
  Handles handles;
  struct Asked {
    allpairs_world* world = nullptr;
    const Handles* handles = nullptr;
    std::size_t calls = 0;
    std::size_t refused = 0;
  } asked;
  asked.handles = &handles;
  allpairs_world_options options{};
  options.struct_size = sizeof options;
  options.accept_context = &asked;
  options.accept = [](void* c, std::uint32_t a, std::uint32_t) {
    Asked& self = *static_cast<Asked*>(c);
    std::uint32_t id = a;
    allpairs_step step;
    ++self.calls;
    self.refused += allpairs_world_step(self.world, &step) == ALLPAIRS_INVALID_ARGUMENT ? 1U : 0U;
    self.refused += allpairs_world_remove(self.world, {&id, 1}) == ALLPAIRS_INVALID_ARGUMENT ? 1U : 0U;
    EXPECT_TRUE(allpairs_world_contains(self.world, a));
    return true;
  };
  ASSERT_EQ(allpairs_world_create(&options, &asked.world), ALLPAIRS_OK);
  std::vector<std::uint32_t> ids(kBoxes);
  ASSERT_EQ(allpairs_world_add(asked.world, handles.set, nullptr, ids.data()), ALLPAIRS_OK);
  allpairs_step step;
  ASSERT_EQ(allpairs_world_step(asked.world, &step), ALLPAIRS_OK);
  EXPECT_GT(step.pairs.count, 100U);
  EXPECT_EQ(asked.refused, 2 * asked.calls);
  allpairs_world_destroy(asked.world);
}

}  // namespace
}  // namespace allpairs
