// SPDX-License-Identifier: MIT
#include "MovingBoxes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "Arguments.h"
#include "Bounds.h"
#include "Executors.h"
#include "allpairs/Error.h"
#include "allpairs/StopFlag.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

WorldOptions optionsOf(double distance, Order order, Executor* executor, const StopFlag& stop) {
  WorldOptions options;
  options.stop = &stop;
  options.order = order;
  options.distance = distance;
  options.executor = executor;
  return options;
}

/// A copy of ids: another thread may change the array while a world without the GIL goes by what it has checked.
std::vector<BoxId> boxIdsOf(const py::buffer& array) {
  const py::buffer_info info = requestBuffer(array, {"I", 0});
  const std::span<const BoxId> ids = valuesOf<BoxId>(info);
  return {ids.begin(), ids.end()};
}

/// Calls take(id) for each, which must be there, as the world itself checks ids.
template <class Take>
void takeEach(const World& world, std::span<const BoxId> ids, const Take& take) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!world.contains(ids[i])) {
      throw InvalidBox(
          i, "there is no box with the id " + std::to_string(ids[i]) + ", entry " + std::to_string(i) + " of the ids");
    }
    take(ids[i]);
  }
}

/// Copies pairs of a search, which may take as long as it does.
std::unique_ptr<PairArray> copyOf(std::span<const Pair> pairs, const StopFlag& stop) {
  constexpr std::size_t kCopiedAtOnce = std::size_t{1} << 20;
  std::vector<Pair> copy;
  copy.reserve(pairs.size());
  while (!pairs.empty()) {
    checkStop(&stop);
    const std::span<const Pair> piece = pairs.first(std::min(pairs.size(), kCopiedAtOnce));
    copy.insert(copy.end(), piece.begin(), piece.end());
    pairs = pairs.subspan(piece.size());
  }
  return toPython(std::move(copy));
}

/// The lists of a step.
struct Lists {
  std::array<std::unique_ptr<PairArray>, 4> each;

  [[nodiscard]] py::tuple arrays() && {
    return py::make_tuple(std::move(each[0]), std::move(each[1]), std::move(each[2]), std::move(each[3]));
  }
};

Lists copyOf(const StepResult& result, const StopFlag& stop) {
  return {{copyOf(result.pairs, stop), copyOf(result.began, stop), copyOf(result.persisted, stop),
           copyOf(result.ended, stop)}};
}

constexpr py::ssize_t kRayColumns = 7;  // origin, direction, length
constexpr py::ssize_t kPointColumns = 3;
constexpr py::ssize_t kBoxColumns = 6;
constexpr py::ssize_t kSweepColumns = 10;  // box, direction, length

std::vector<Ray> raysOf(std::span<const double> rows) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i + 6 < rows.size(); i += 7) {
    const double* row = &rows[i];
    rays.push_back({{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, row[6]});
  }
  return rays;
}

std::vector<BoxSweep> sweepsOf(std::span<const double> rows) {
  std::vector<BoxSweep> sweeps;
  for (std::size_t i = 0; i + 9 < rows.size(); i += 10) {
    const double* row = &rows[i];
    const Box box{{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
    sweeps.push_back({box, {row[6], row[7], row[8]}, row[9]});
  }
  return sweeps;
}

/// Calls ask(rays) or ask(sweeps), of a buffer whose rows are those of the one or of the other.
template <class Ask>
void askOf(const py::buffer_info& info, const Ask& ask) {
  const std::span<const double> rows = valuesOf<double>(info);
  if (info.shape[1] == kSweepColumns) {
    ask(sweepsOf(rows));
  } else {
    ask(raysOf(rows));
  }
}

/// Requests a buffer of rows of one of two widths.
py::buffer_info requestRows(const py::buffer& rows, py::ssize_t wide, py::ssize_t narrow) {
  const py::buffer_info info = rows.request();
  return requestBuffer(rows, {"d", info.ndim == 2 && info.shape[1] == wide ? wide : narrow});
}

std::vector<std::array<double, 3>> pointsOf(std::span<const double> rows) {
  std::vector<std::array<double, 3>> points;
  for (std::size_t i = 0; i + 2 < rows.size(); i += 3) points.push_back({rows[i], rows[i + 1], rows[i + 2]});
  return points;
}

/// Sets a property of each box from a contiguous buffer with a number for each.
template <class T, class Set>
void setEach(std::vector<BoxProperties>& boxes, const py::buffer& values, const Set& set) {
  const py::buffer_info info = requestBuffer(values, {py::format_descriptor<T>::format(), 0});
  const std::span<const T> numbers = valuesOf<T>(info);
  if (numbers.size() != boxes.size()) throw InvalidArgument("properties of another length");
  for (std::size_t i = 0; i < numbers.size(); ++i) set(boxes[i], numbers[i]);
}

/// The properties of boxes, as columns.
struct PropertyColumns {
  std::vector<std::uint32_t> labels;
  std::vector<double> margins;

  void add(const BoxProperties& box) {
    labels.insert(labels.end(), {box.category, box.mask, box.group, box.isStatic ? 1U : 0U, box.world});
    margins.push_back(box.margin);
  }
};

/// Ids and a number for each, as two arrays.
struct Found {
  std::vector<std::uint32_t> ids;
  std::vector<double> numbers;

  void reserve(std::size_t count) {
    ids.reserve(count);
    numbers.reserve(count);
  }

  void add(const SweepHit& hit) {
    ids.push_back(hit.id);
    numbers.push_back(hit.t);
  }

  [[nodiscard]] py::tuple arrays(py::ssize_t columns = 0) && {
    return py::make_tuple(arrayOf(std::move(ids), columns), arrayOf(std::move(numbers), columns));
  }
};

}  // namespace

void Properties::setField(std::uint32_t BoxProperties::*field, const py::buffer& values) {
  setEach<std::uint32_t>(m_values, values, [field](BoxProperties& box, std::uint32_t value) { box.*field = value; });
  m_fields.push_back(field);
}

void Properties::setMargins(const py::buffer& values) {
  setEach<double>(m_values, values, [](BoxProperties& box, double margin) { box.margin = margin; });
  m_hasMargins = true;
}

void Properties::setStatic(const py::buffer& values) {
  setEach<std::uint32_t>(m_values, values, [](BoxProperties& box, std::uint32_t flag) { box.isStatic = flag != 0; });
  m_hasStatic = true;
}

BoxProperties Properties::over(BoxProperties before, std::size_t box) const {
  const BoxProperties& set = m_values[box];
  for (const auto field : m_fields) before.*field = set.*field;
  if (m_hasMargins) before.margin = set.margin;
  if (m_hasStatic) before.isStatic = set.isStatic;
  return before;
}

MovingBoxes::MovingBoxes(double distance, Order order, std::size_t threads)
    : m_executor(executorOf(threads)), m_world(optionsOf(distance, order, m_executor.get(), m_stop.flag())) {}

MovingBoxes::Ids MovingBoxes::add(const Boxes& boxes, const Properties& properties) {
  // All memory first: boxes whose ids nobody knows could never be removed.
  auto ids = arrayOf(std::vector<BoxId>(boxes.set().size()));
  alone([&](World& world) {
    world.add(boxes.set(), properties.values(), ids->values());
    m_size = world.size();
  });
  return ids;
}

void MovingBoxes::move(const py::buffer& ids, const Boxes& boxes) {
  const std::vector<BoxId> chosen = boxIdsOf(ids);
  alone([&](World& world) { world.move(chosen, boxes.set()); });
}

void MovingBoxes::moveSwept(const py::buffer& ids, const Boxes& starts, const Boxes& ends) {
  const std::vector<BoxId> chosen = boxIdsOf(ids);
  alone([&](World& world) { world.moveSwept(chosen, starts.set(), ends.set()); });
}

void MovingBoxes::remove(const py::buffer& ids) {
  const std::vector<BoxId> chosen = boxIdsOf(ids);
  alone([&](World& world) {
    world.remove(chosen);
    m_size = world.size();
  });
}

void MovingBoxes::clear() {
  alone([&](World& world) {
    world.clear();
    m_size = 0;
  });
}

void MovingBoxes::setProperties(const py::buffer& ids, const Properties& properties) {
  const std::vector<BoxId> chosen = boxIdsOf(ids);
  if (properties.values().size() != chosen.size()) throw InvalidArgument("properties of another length");
  alone([&](World& world) {
    std::vector<BoxProperties> each;
    each.reserve(chosen.size());
    for (const BoxId id : chosen) {
      // An id that is not there is refused below.
      each.push_back(properties.over(world.contains(id) ? world.properties(id) : BoxProperties(), each.size()));
    }
    world.setProperties(chosen, each);
  });
}

void MovingBoxes::reserve(std::size_t boxes) {
  alone([boxes](World& world) { world.reserve(boxes); });
}

void MovingBoxes::shrink() {
  alone([](World& world) { world.shrink(); });
}

std::size_t MovingBoxes::size() {
  return alone([](World& world) { return world.size(); });
}

bool MovingBoxes::contains(BoxId id) {
  return alone([id](World& world) { return world.contains(id); });
}

MovingBoxes::Numbers MovingBoxes::boxes(const py::buffer& ids) {
  const std::vector<BoxId> chosen = boxIdsOf(ids);
  std::vector<double> bounds;
  bounds.reserve(6 * chosen.size());
  alone([&](World& world) { takeEach(world, chosen, [&](BoxId id) { append(bounds, world.box(id)); }); });
  return arrayOf(std::move(bounds), 6);
}

MovingBoxes::Ids MovingBoxes::ids() {
  std::vector<BoxId> ids;
  alone([&](World& world) {
    ids.reserve(world.size());
    for (BoxId id = 0; id < world.idBound(); ++id) {
      if (world.contains(id)) ids.push_back(id);
    }
  });
  return arrayOf(std::move(ids));
}

py::tuple MovingBoxes::properties(const py::buffer& ids) {
  const std::vector<BoxId> chosen = boxIdsOf(ids);
  PropertyColumns columns;
  alone([&](World& world) { takeEach(world, chosen, [&](BoxId id) { columns.add(world.properties(id)); }); });
  return py::make_tuple(arrayOf(std::move(columns.labels), 5), arrayOf(std::move(columns.margins)));
}

py::tuple MovingBoxes::state() {
  std::vector<BoxId> ids;
  std::vector<double> bounds;
  PropertyColumns columns;
  alone([&](World& world) {
    for (BoxId id = 0; id < world.idBound(); ++id) {
      if (!world.contains(id)) continue;
      ids.push_back(id);
      append(bounds, world.box(id));
      columns.add(world.properties(id));
    }
  });
  return py::make_tuple(arrayOf(std::move(ids)), arrayOf(std::move(bounds), 6), arrayOf(std::move(columns.labels), 5),
                        arrayOf(std::move(columns.margins)));
}

py::tuple MovingBoxes::step() {
  Lists lists;
  std::uint64_t done = 0;  // the number of the step, which is not repeated if only copying is
  search(0, [&](World& world) {
    if (done == 0) {
      const std::uint64_t number = ++m_steps;
      static_cast<void>(world.step());
      done = number;
    }
    if (done != m_steps) throw Error("the lists of this step are gone: there was another while a signal was handled");
    lists = copyOf(world.result(), m_stop.flag());
  });
  return std::move(lists).arrays();
}

py::tuple MovingBoxes::resultOf(std::uint32_t world) {
  Lists lists;
  search(0, [&](World& worlds) { lists = copyOf(worlds.result(world), m_stop.flag()); });
  return std::move(lists).arrays();
}

WorldStatistics MovingBoxes::statistics() {
  return alone([](World& world) { return world.statistics(); });
}

std::unique_ptr<PairArray> MovingBoxes::overlapping(const Boxes& boxes, const QueryFilter& filter) {
  return search(boxes.set().size(), [&](World& world) {
    const ResultLists<BoxId> found = world.findOverlapping(boxes.set(), filter);
    std::vector<Pair> pairs;
    pairs.reserve(found.values.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      checkStop(&m_stop.flag());
      for (const BoxId id : found[i]) pairs.push_back({static_cast<std::uint32_t>(i), id});
    }
    return toPython(std::move(pairs));
  });
}

py::tuple MovingBoxes::firstHits(const py::buffer& sweeps, const QueryFilter& filter) {
  const py::buffer_info info = requestRows(sweeps, kSweepColumns, kRayColumns);
  const auto count = static_cast<std::size_t>(info.shape[0]);
  Found found;
  search(count, [&](World& world) {
    std::vector<SweepHit> hits(count);
    askOf(info, [&](const auto& asked) { world.findFirst(asked, hits, filter); });
    found = {};
    for (const SweepHit& hit : hits) found.add(hit);
  });
  return std::move(found).arrays();
}

py::tuple MovingBoxes::allHits(const py::buffer& sweeps, const QueryFilter& filter) {
  const py::buffer_info info = requestRows(sweeps, kSweepColumns, kRayColumns);
  std::vector<std::uint64_t> offsets;
  Found found;
  search(static_cast<std::size_t>(info.shape[0]), [&](World& world) {
    ResultLists<SweepHit> lists;
    askOf(info, [&](const auto& asked) { lists = world.findAll(asked, filter); });
    offsets.assign(lists.offsets.begin(), lists.offsets.end());
    found = {};
    found.reserve(lists.values.size());
    for (std::size_t i = 0; i < lists.size(); ++i) {
      checkStop(&m_stop.flag());
      for (const SweepHit& hit : lists[i]) found.add(hit);
    }
  });
  return py::make_tuple(arrayOf(std::move(offsets)), arrayOf(std::move(found.ids)), arrayOf(std::move(found.numbers)));
}

py::tuple MovingBoxes::nearest(const py::buffer& queries, std::size_t count, const QueryFilter& filter) {
  const py::buffer_info info = requestRows(queries, kBoxColumns, kPointColumns);
  const bool areBoxes = info.shape[1] == kBoxColumns;
  const auto size = static_cast<std::size_t>(info.shape[0]);
  Found found;
  search(size, [&](World& world) {
    const std::span<const double> rows = valuesOf<double>(info);
    const ResultLists<Neighbor> lists = areBoxes ? world.findNearest(BoxView::fromRows(rows), count, filter)
                                                 : world.findNearest(pointsOf(rows), count, filter);
    if (size != 0 && count > found.numbers.max_size() / size) throw std::bad_alloc();
    found.ids.assign(size * count, kNoBox);
    found.numbers.assign(size * count, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k < lists[i].size(); ++k) {
        found.ids[i * count + k] = lists[i][k].id;
        found.numbers[i * count + k] = lists[i][k].distance;
      }
    }
  });
  return std::move(found).arrays(static_cast<py::ssize_t>(count));
}

std::unique_ptr<PairArray> MovingBoxes::between(MovingBoxes& other) {
  return interruptibly(m_size + other.m_size, runs(), [&](Stopper& stopper) {
    std::unique_lock lock(m_mutex, std::defer_lock);
    std::unique_lock otherLock(other.m_mutex, std::defer_lock);
    // Both at once: two threads may ask for the same two in either order.
    &other == this ? lock.lock() : std::lock(lock, otherLock);
    const Stopper::Hold hold(stopper, m_stop);
    return toPython(m_world.findBetween(other.m_world));
  });
}

}  // namespace allpairs::python
