// SPDX-License-Identifier: MIT
// The library for C as a state machine: calls in any order, on handles that may be null, with arguments that may make
// no sense. Every call must give a status that fits, and what the calls say of one thing must agree.
#include "allpairs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "../Choices.h"
#include "CQueries.h"
#include "CSearch.h"
#include "CWorld.h"

namespace allpairs::fuzz {
namespace {

constexpr std::size_t kHandles = 3;
constexpr std::size_t kMostCalls = 150;

/// A set and the numbers that it views.
struct SetHandle {
  std::vector<float> float32;
  std::vector<double> float64, margins;
  std::vector<Box> boxes;  ///< As the set has them.
  bool mayHaveMargins = false;
  allpairs_set* set = nullptr;
};

/// What the filters of a search point to: as long as any set here may be.
struct Labels {
  std::array<std::uint32_t, 256> values{};
};

class Calls {
 public:
  explicit Calls(Choices& choices) : m_choices(choices) {
    for (std::uint32_t i = 0; i < m_labels.values.size(); ++i) m_labels.values[i] = i * 2654435761U >> 29;
  }

  ~Calls() {
    for (SetHandle& each : m_sets) allpairs_set_destroy(each.set);
    for (allpairs_search* each : m_searches) allpairs_search_destroy(each);
    for (const CWorld& each : m_worlds) allpairs_world_destroy(each.world);
    for (allpairs_elements* each : m_elements) allpairs_elements_destroy(each);
  }
  Calls(const Calls&) = delete;
  Calls& operator=(const Calls&) = delete;
  Calls(Calls&&) = delete;
  Calls& operator=(Calls&&) = delete;

  void make() {
    for (std::size_t i = 0; i < kMostCalls && !m_choices.done(); ++i) call();
  }

 private:
  void call() {
    using Operation = void (Calls::*)();
    static constexpr std::array<Operation, 16> kOperations{
        &Calls::createSet, &Calls::setMargins,    &Calls::createSearch,   &Calls::setOptions,
        &Calls::find,      &Calls::findBetween,   &Calls::createWorld,    &Calls::add,
        &Calls::change,    &Calls::change,        &Calls::step,           &Calls::query,
        &Calls::queryMany, &Calls::betweenWorlds, &Calls::createElements, &Calls::useElements};
    static constexpr std::array<Operation, 7> kRarer{&Calls::findInto,    &Calls::findRows,  &Calls::findInWorlds,
                                                     &Calls::addToWorlds, &Calls::setWorlds, &Calls::restrictQueries,
                                                     &Calls::shrink};
    static constexpr std::array<Operation, 4> kRarest{&Calls::tellOfWorld, &Calls::moveByVelocities, &Calls::stop,
                                                      &Calls::addEachBox};
    const std::uint8_t choice = m_choices.byte();
    if (choice >= 250) return (this->*kRarest[choice % kRarest.size()])();
    const bool isRarer = choice >= 160;
    (this->*(isRarer ? kRarer[choice % kRarer.size()] : kOperations[choice % kOperations.size()]))();
  }

  template <class T>
  T* maybeNull(T* value) {
    return m_choices.byte() == 255 ? nullptr : value;
  }

  SetHandle& anySet() { return m_sets[m_choices.below(kHandles)]; }
  allpairs_search* anySearch() { return m_searches[m_choices.below(kHandles)]; }
  CWorld& anyHandle() { return m_worlds[m_choices.below(kHandles)]; }
  allpairs_world* anyWorld() { return anyHandle().world; }

  void createSet() {
    SetHandle& handle = anySet();
    allpairs_set_destroy(handle.set);
    handle = {};
    std::vector<Box> boxes = m_choices.boxes(100);
    const bool hasNan = m_choices.byte() == 255;
    if (hasNan) boxes.back().max[1] = std::numeric_limits<double>::quiet_NaN();
    for (const Box& box : boxes) {
      handle.float64.insert(handle.float64.end(), box.min.begin(), box.min.end());
      handle.float64.insert(handle.float64.end(), box.max.begin(), box.max.end());
    }
    for (const double value : handle.float64) handle.float32.push_back(static_cast<float>(value));
    handle.boxes = boxes;
    const allpairs_status status = checked(createFrom(handle, boxes.size()));
    require(status == (hasNan ? ALLPAIRS_INVALID_BOX : ALLPAIRS_OK), "a set is refused for a NaN only");
    require((handle.set == nullptr) == hasNan, "a set is there if its creation succeeded");
    require(allpairs_set_size(handle.set) == (hasNan ? 0 : boxes.size()), "a set has the size of its boxes");
  }

  allpairs_status createFrom(SetHandle& handle, std::size_t count) {
    require(checked(allpairs_set_create_f64(nullptr, count, &handle.set)) == ALLPAIRS_INVALID_ARGUMENT, "null refused");
    const auto last = static_cast<std::ptrdiff_t>(6 * (count - 1));
    const float* f = handle.float32.data();
    const double* d = handle.float64.data();
    const std::size_t way = m_choices.below(4);
    for (Box& box : handle.boxes) box = way % 2 == 0 ? asFloat32(box) : box;
    if (way == 2) std::reverse(handle.boxes.begin(), handle.boxes.end());
    switch (way) {
      case 0:
        return allpairs_set_create_f32(f, count, &handle.set);
      case 1:
        return allpairs_set_create_f64(d, count, &handle.set);
      case 2:
        return allpairs_set_create_strided_f32(count, {f + last, -6, 1}, {f + last + 3, -6, 1}, &handle.set);
      default:
        return allpairs_set_create_strided_f64(count, {d, 6, 1}, {d + 3, 6, 1}, &handle.set);
    }
  }

  void setMargins() {
    SetHandle& handle = anySet();
    const double margin = m_choices.anyNumber();
    handle.mayHaveMargins = true;
    const bool isFine =
        handle.set != nullptr && !std::isnan(margin) && margin != -std::numeric_limits<double>::infinity();
    require((checked(allpairs_set_margin(handle.set, margin)) == ALLPAIRS_OK) == isFine, "a margin is a number");
    if (handle.set == nullptr || m_choices.flag()) return;
    handle.margins.assign(allpairs_set_size(handle.set), 0.0);
    for (double& each : handle.margins) each = m_choices.distance();
    require(checked(allpairs_set_margins(handle.set, handle.margins.data())) == ALLPAIRS_OK, "margins are taken");
    if (m_choices.flag()) checked(allpairs_set_margins(handle.set, nullptr));
  }

  allpairs_options options() {
    allpairs_options result = allpairs_default_options();
    const std::uint8_t parts = m_choices.byte();
    result.strategy = static_cast<allpairs_strategy>(m_choices.below(3));
    result.order = static_cast<allpairs_order>(m_choices.below(3));
    result.distance = m_choices.anyNumber();
    if ((parts & 1U) != 0) result.region = region();
    if ((parts & 2U) != 0)
      result.first = {m_labels.values.data(), m_labels.values.data() + 50, m_labels.values.data() + 99};
    if ((parts & 4U) != 0) result.second = {m_labels.values.data() + 7, nullptr, m_labels.values.data() + 13};
    if ((parts & 8U) != 0) result.accept = acceptSome;
    result.accept_context = &m_salt;
    if ((parts & 0xf0U) == 0xf0U) result.threads = 2;
    if ((parts & 16U) != 0) result.max_pairs = m_choices.below(1000);
    if (m_choices.byte() == 255) result.struct_size = m_choices.below(300);
    return result;
  }

  const double* region() {
    for (double& bound : m_region) bound = m_choices.anyNumber();
    return m_region.data();
  }

  void createSearch() {
    allpairs_search*& search = m_searches[m_choices.below(kHandles)];
    allpairs_search_destroy(search);
    search = nullptr;
    const allpairs_options given = options();
    const allpairs_status status = checked(allpairs_search_create(maybeNull(&given), &search));
    require((status == ALLPAIRS_OK) == (search != nullptr), "a search is there if its creation succeeded");
  }

  void setOptions() {
    allpairs_search* search = anySearch();
    const allpairs_options given = options();
    const allpairs_status status = checked(allpairs_search_set_options(search, maybeNull(&given)));
    require(search != nullptr || status == ALLPAIRS_INVALID_ARGUMENT, "no handle is an invalid argument");
  }

  void find() { compareSearch({anySearch(), anySet().set}); }
  void findBetween() { compareSearch({anySearch(), anySet().set, anySet().set}); }
  void compareSearch(const CSearch& search) { search.compareAll(m_choices.below(100), m_choices.byte() == 255); }

  CSearch anyCSearch() { return {anySearch(), anySet().set, m_choices.flag() ? anySet().set : nullptr}; }

  void findInto() { anyCSearch().compareInto(m_choices.byte() >= 192); }

  void findRows() { anyCSearch().compareRows(static_cast<allpairs_rows_kind>(m_choices.below(2))); }

  /// Finding, counting and listing in worlds agree.
  void findInWorlds() {
    allpairs_search* const search = anySearch();
    const SetHandle& handle = anySet();
    std::vector<std::uint64_t> offsets{0};
    const std::size_t count = m_choices.below(6);
    for (std::size_t k = 0; k < count; ++k) offsets.push_back(offsets.back() + m_choices.below(40));
    if (m_choices.byte() < 240) offsets.back() = allpairs_set_size(handle.set);
    const allpairs_pair ignored{static_cast<std::uint32_t>(m_choices.below(20)), 1};
    allpairs_worlds worlds{};
    worlds.struct_size = sizeof(worlds);
    worlds.boxes = handle.set;
    worlds.count = count;
    if (m_choices.flag()) worlds.begin = offsets.data();
    if (m_choices.byte() >= 192) worlds.shared = anySet().set;
    if (m_choices.byte() >= 192) worlds.ignored = &ignored, worlds.ignored_count = 1;
    worlds.filter_is_of_one = m_choices.byte() >= 224;
    compareWorlds(search, worlds);
  }

  void createWorld() {
    CWorld& handle = anyHandle();
    allpairs_world_destroy(handle.world);
    handle = {};
    allpairs_world_options given{};
    given.struct_size = m_choices.byte() == 255 ? m_choices.below(100) : sizeof(given);
    given.distance = m_choices.anyNumber();
    given.order = static_cast<allpairs_order>(m_choices.below(3));
    if (m_choices.flag()) given.accept = acceptSome;
    given.accept_context = &m_salt;
    if (m_choices.byte() == 255) given.threads = 2;
    const allpairs_world_options* const options = maybeNull(&given);
    const allpairs_status status = checked(allpairs_world_create(options, &handle.world));
    require((status == ALLPAIRS_OK) == (handle.world != nullptr), "a world is there if its creation succeeded");
    if (options != nullptr) handle.take(given);
  }

  allpairs_properties properties() {
    allpairs_properties result = allpairs_default_properties();
    if (m_choices.flag()) return result;
    result.category = 1U << m_choices.below(3);
    result.mask = m_choices.byte();
    result.group = m_choices.byte() % 3U;
    result.margin = m_choices.anyNumber();
    result.is_static = m_choices.flag();
    return result;
  }

  void add() {
    allpairs_world* world = anyWorld();
    const SetHandle& handle = anySet();
    const std::size_t before = allpairs_world_size(world);
    if (before > 400) return;
    const allpairs_properties given = properties();
    std::vector<std::uint32_t> ids(allpairs_set_size(handle.set));
    requireAdded(world, before, ids,
                 checked(allpairs_world_add(world, handle.set, maybeNull(&given), maybeNull(ids.data()))));
  }

  void addEachBox() {
    allpairs_world* world = anyWorld();
    const SetHandle& handle = anySet();
    if (allpairs_world_size(world) <= 400) addEach(world, handle.set, properties());
  }

  /// Each as likely.
  std::uint32_t anyNumber() { return kNumbers[m_choices.below(kNumbers.size())]; }

  void addToWorlds() {
    allpairs_world* world = anyWorld();
    const SetHandle& handle = anySet();
    const std::size_t before = allpairs_world_size(world);
    if (before > 400) return;
    const allpairs_properties given = properties();
    std::vector<std::uint32_t> numbers(allpairs_set_size(handle.set));
    for (std::uint32_t& number : numbers) number = anyNumber();
    const allpairs_membership membership{m_choices.flag() ? &given : nullptr,
                                         m_choices.byte() >= 32 ? numbers.data() : nullptr};
    std::vector<std::uint32_t> ids(numbers.size());
    const allpairs_status status =
        checked(allpairs_world_add_to_worlds(world, handle.set, maybeNull(&membership), ids.data()));
    requireAdded(world, before, ids, status);
  }

  void setWorlds() {
    allpairs_world* world = anyWorld();
    const std::vector<std::uint32_t> list = ids(world, 1 + m_choices.below(20));
    std::vector<std::uint32_t> numbers(list.size());
    for (std::uint32_t& number : numbers) number = anyNumber();
    checked(allpairs_world_set_worlds(world, {list.data(), list.size()}, maybeNull(numbers.data())));
  }

  void restrictQueries() {
    CWorld& handle = anyHandle();
    const std::uint32_t number = anyNumber();
    if (checked(allpairs_world_restrict_queries(handle.world, number)) == ALLPAIRS_OK) handle.queried = number;
  }

  void shrink() {
    checked(allpairs_search_shrink(anySearch()));
    checked(allpairs_world_shrink(anyWorld()));
    checked(allpairs_elements_shrink(m_elements[m_choices.below(kHandles)]));
  }

  /// Ids of a world, now and then one that isn't there.
  std::vector<std::uint32_t> ids(const allpairs_world* world, std::size_t count) {
    std::vector<std::uint32_t> result;
    std::uint32_t id = m_choices.byte();
    for (std::size_t tries = 0; tries < 600 && result.size() < count; ++tries, ++id) {
      if (allpairs_world_contains(world, id % 600)) result.push_back(id % 600);
    }
    if (m_choices.byte() >= 240) result.resize(count, m_choices.raw<std::uint32_t>());
    return result;
  }

  void change() {
    allpairs_world* world = anyWorld();
    const SetHandle& handle = anySet();
    const std::size_t kind = m_choices.below(6);
    const std::size_t count = kind < 2 ? allpairs_set_size(handle.set) : 1 + m_choices.below(20);
    const std::vector<std::uint32_t> list = ids(world, count);
    const allpairs_ids view{list.data(), list.size()};
    const std::vector<allpairs_properties> each(list.size(), properties());
    const std::size_t before = allpairs_world_size(world);
    allpairs_status status = ALLPAIRS_OK;
    if (kind == 0) status = allpairs_world_move(world, view, handle.set);
    if (kind == 1) status = allpairs_world_move_swept(world, view, handle.set, handle.set);
    if (kind == 2) status = allpairs_world_remove(world, view);
    if (kind == 3) status = allpairs_world_set_properties(world, view, each.data());
    if (kind == 4) status = allpairs_world_invalidate(world, view);
    if (kind == 5) status = allpairs_world_set_properties(world, {list.data(), std::size_t{0} - list.size()}, nullptr);
    const bool isRemoved = checked(status) == ALLPAIRS_OK && kind == 2;
    require(allpairs_world_size(world) == before - (isRemoved ? list.size() : 0),
            "boxes are removed all or not at all");
  }

  void tellOfWorld() {
    allpairs_world* world = anyWorld();
    reserve(world,
            m_choices.byte() >= 250 ? m_choices.raw<std::size_t>() | std::size_t{1} << 40 : m_choices.below(999));
    checkStatistics(world, m_choices.byte() >= 192 ? m_choices.below(80) : sizeof(allpairs_step_statistics));
  }

  void moveByVelocities() {
    allpairs_world* world = anyWorld();
    const SetHandle& handle = anySet();
    const std::vector<std::uint32_t> list = ids(world, allpairs_set_size(handle.set));
    std::vector<double> velocities(3 * allpairs_set_size(handle.set));
    for (double& each : velocities) each = m_choices.anyNumber();
    const allpairs_velocities motion{maybeNull(velocities.data()), m_choices.anyNumber()};
    checked(allpairs_world_move_swept_by(world, {list.data(), list.size()}, handle.set, maybeNull(&motion)));
  }

  void stop() {
    const CSearch search = anyCSearch();
    allpairs_options given = options();
    given.instruction_set = allpairs_instruction_set(m_choices.below(20));
    stopSearch(search, given);
  }

  void step() {
    allpairs_world* world = anyWorld();
    allpairs_step step{};
    if (checked(allpairs_world_step(world, maybeNull(&step))) != ALLPAIRS_OK) return;
    require(step.began.count + step.persisted.count == step.pairs.count, "a pair began or persisted");
    for (std::size_t i = 0; i < step.pairs.count; ++i) {
      const allpairs_pair& pair = step.pairs.data[i];
      require(pair.first < pair.second, "a pair is ordered");
      require(allpairs_world_contains(world, pair.first) && allpairs_world_contains(world, pair.second),
              "a pair is of boxes that are there");
      std::array<double, 6> bounds{};
      require(checked(allpairs_world_box(world, pair.first, bounds.data())) == ALLPAIRS_OK, "a box can be asked for");
    }
    compareResults(world, step);
  }

  allpairs_query_filter filter() {
    const std::uint8_t parts = m_choices.byte();
    if (parts < 128) return {~0U, ~0U, false, false};
    return {parts % 8U, parts % 16U, (parts & 16U) != 0, (parts & 32U) != 0};
  }

  allpairs_ray ray() {
    allpairs_ray result{};
    for (double& x : result.origin) x = m_choices.anyNumber();
    for (double& x : result.direction) x = m_choices.anyNumber();
    result.length = m_choices.anyNumber();
    return result;
  }

  allpairs_sweep sweep() {
    allpairs_sweep result{};
    for (double& x : result.box) x = m_choices.anyNumber();
    for (double& x : result.motion) x = m_choices.anyNumber();
    result.length = m_choices.anyNumber();
    return result;
  }

  void query() {
    CQueries queries{anyHandle(), filter()};
    const allpairs_ray way = ray();
    const allpairs_sweep moving = sweep();
    const allpairs_nearest nearest{{way.origin[0], way.origin[1], way.origin[2]}, m_choices.below(600)};
    queries.compareOverlapping(moving.box, m_choices.byte() == 255);
    queries.compare(way);
    queries.compare(moving);
    queries.compareNearest(nearest);
  }

  void queryMany() {
    CQueries queries{anyHandle(), filter()};
    std::vector<allpairs_ray> rays(m_choices.below(4));
    for (allpairs_ray& each : rays) each = ray();
    std::vector<allpairs_sweep> sweeps(m_choices.below(4));
    for (allpairs_sweep& each : sweeps) each = sweep();
    const SetHandle& overlapped = anySet();
    queries.compareOverlapping(overlapped.set, overlapped.boxes, overlapped.mayHaveMargins);
    queries.compare(rays);
    queries.compare(sweeps);
    std::vector<double> points;
    for (const allpairs_ray& each : rays) points.insert(points.end(), each.origin, each.origin + 3);
    const std::size_t count = m_choices.below(20);
    queries.compareNearest(points, count);
    const SetHandle& close = anySet();
    queries.compareNearest({close.set, count}, close.boxes, close.mayHaveMargins);
  }

  void betweenWorlds() {
    const CWorld& first = anyHandle();
    const CWorld& second = anyHandle();
    compareBetween(first, second, m_choices.byte() == 255);
  }

  void createElements() {
    allpairs_elements*& elements = m_elements[m_choices.below(kHandles)];
    allpairs_elements_destroy(elements);
    elements = nullptr;
    std::array<std::vector<std::uint32_t>, 2> corners;
    std::array<allpairs_mesh, 2> meshes{};
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const std::size_t vertices = m_choices.below(40);
      corners[m].resize(3 * m_choices.below(30));
      const bool mayBeMissing = m_choices.byte() >= 240;
      for (std::uint32_t& corner : corners[m]) {
        corner =
            static_cast<std::uint32_t>(m_choices.below(std::max<std::size_t>(1, vertices + (mayBeMissing ? 2 : 0))));
      }
      meshes[m] = {vertices, corners[m].data(), corners[m].size() / 3};
    }
    allpairs_elements_options given{};
    given.struct_size = sizeof(given);
    given.distance = m_choices.anyNumber();
    given.skip_within = m_choices.byte() >= 200;
    given.skip_between = m_choices.byte() >= 200;
    given.order = static_cast<allpairs_order>(m_choices.below(3));
    const std::size_t count = m_choices.below(3);
    const allpairs_status status =
        checked(allpairs_elements_create(meshes.data(), count, maybeNull(&given), &elements));
    require((status == ALLPAIRS_OK) == (elements != nullptr), "candidates are there if their creation succeeded");
  }

  void useElements() {
    allpairs_elements* elements = m_elements[m_choices.below(kHandles)];
    moveElements(elements, m_choices.below(3));
    const auto kind = static_cast<allpairs_candidates>(m_choices.below(3));
    if (!compareCandidates(elements, kind)) return;
    allpairs_pairs pairs{};
    checked(allpairs_elements_edges(elements, maybeNull(&pairs)));
  }

  void moveElements(allpairs_elements* elements, std::size_t mesh) {
    allpairs_element_counts before{};
    allpairs_element_counts after{};
    if (checked(allpairs_elements_before(elements, mesh, &before)) != ALLPAIRS_OK) return;
    if (checked(allpairs_elements_before(elements, mesh + 1, &after)) != ALLPAIRS_OK) return;
    std::vector<double> start(3 * (after.vertices - before.vertices));
    for (double& x : start) x = m_choices.byte() == 255 ? m_choices.anyNumber() : m_choices.finite();
    std::vector<double> end = start;
    for (double& x : end) x += m_choices.finite();
    if (m_choices.flag()) {
      checked(allpairs_elements_move_f64(elements, mesh, start.data(), end.data()));
      return;
    }
    std::vector<float> first, last;
    for (const double x : start) first.push_back(static_cast<float>(x));
    for (const double x : end) last.push_back(static_cast<float>(x));
    checked(allpairs_elements_move_f32(elements, mesh, first.data(), last.data()));
  }

  Choices& m_choices;
  std::uint8_t m_salt = 1;
  Labels m_labels;
  std::array<double, 6> m_region{};
  std::array<SetHandle, kHandles> m_sets;
  std::array<allpairs_search*, kHandles> m_searches{};
  std::array<CWorld, kHandles> m_worlds{};
  std::array<allpairs_elements*, kHandles> m_elements{};
};

void runC(Bytes bytes) {
  Choices choices(bytes);
  Calls(choices).make();
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(c, allpairs::fuzz::runC)
