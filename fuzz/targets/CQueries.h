// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>
#include <vector>

#include "CSearch.h"
#include "engine/WorldOracle.h"

namespace allpairs::fuzz {

/// A world, and what there is no call to ask for.
struct CWorld {
  allpairs_world* world = nullptr;
  double distance = 0.0;
  allpairs_order order = ALLPAIRS_BY_FIRST;
  bool accepts = false;
  void* context = nullptr;
  std::uint32_t queried = kEveryWorld;  ///< Whose boxes queries consider.

  /// As much of the options as their size says, which is what the library reads.
  void take(const allpairs_world_options& given) {
    allpairs_world_options read{};
    std::memcpy(&read, &given, std::min(given.struct_size, sizeof(read)));
    distance = read.distance;
    order = read.order;
    accepts = read.accept != nullptr;
    context = read.accept_context;
  }
};

/// What a world tells of its boxes, for double loops.
inline test::WorldOracle oracleOf(const CWorld& of) {
  test::WorldOracle oracle;
  oracle.order = of.order == ALLPAIRS_BY_SECOND ? Order::BySecond : Order::ByFirst;
  std::vector<std::uint32_t> ids(allpairs_world_size(of.world));
  require(checked(allpairs_world_list_ids(of.world, ids.data())) == ALLPAIRS_OK, "a world lists its ids");
  require(std::is_sorted(ids.begin(), ids.end(), std::less_equal<>()), "ids are listed once, ascending");
  for (const std::uint32_t id : ids) {
    test::WorldOracle::Entry& entry = oracle.boxes[id];
    std::array<double, 6> bounds{};
    allpairs_properties p{};
    require(checked(allpairs_world_box(of.world, id, bounds.data())) == ALLPAIRS_OK, "a box has bounds");
    require(checked(allpairs_world_properties(of.world, id, &p)) == ALLPAIRS_OK, "a box has properties");
    entry.box = {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}};
    entry.properties = {.category = p.category, .mask = p.mask, .group = p.group, .margin = p.margin};
    entry.properties.isStatic = p.is_static;
    require(checked(allpairs_world_number(of.world, id, &entry.properties.world)) == ALLPAIRS_OK, "a box has a world");
  }
  return oracle;
}

inline bool isHit(const allpairs_hit& a, const SweepHit& b) { return a.id == b.id && a.t == b.t; }
inline bool isNeighbor(const allpairs_neighbor& a, const Neighbor& b) {
  return a.id == b.id && a.distance == b.distance;
}
inline bool isId(std::uint32_t a, BoxId b) { return a == b; }

/// A box of six numbers, which may be none.
inline Box boxOf(const double* bounds) {
  return {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}};
}

inline BoxSweep sweepOf(const allpairs_sweep& s) {
  return {boxOf(s.box), {s.motion[0], s.motion[1], s.motion[2]}, s.length};
}
inline BoxSweep sweepOf(const allpairs_ray& r) {
  return {{{r.origin[0], r.origin[1], r.origin[2]}, {r.origin[0], r.origin[1], r.origin[2]}},
          {r.direction[0], r.direction[1], r.direction[2]},
          r.length};
}

template <class Numbers>
bool areFinite(const Numbers& numbers) {
  return std::all_of(std::begin(numbers), std::end(numbers), [](double x) { return std::isfinite(x); });
}

inline bool isSound(const allpairs_ray& r) { return areFinite(r.origin) && areFinite(r.direction) && r.length >= 0.0; }
inline bool isSound(const allpairs_sweep& s) { return areFinite(s.box) && areFinite(s.motion) && s.length >= 0.0; }

/// The first hits of queries, all hits, and what the calls said.
template <class All>
struct Hits {
  std::vector<allpairs_hit> first;
  All all{};
  allpairs_status firstStatus = ALLPAIRS_OK;
  allpairs_status allStatus = ALLPAIRS_OK;
};

/// Queries of a world, alone and many at once, beside those of the double loop.
class CQueries {
 public:
  CQueries(const CWorld& of, const allpairs_query_filter& filter) : m_world(of.world), m_filter(filter) {
    if (m_world != nullptr) m_oracle = oracleOf(of);
    m_wanted = {.category = filter.category, .mask = filter.mask, .world = of.queried};
    m_wanted.staticBoxes = !filter.skip_static;
    m_wanted.dynamicBoxes = !filter.skip_moving;
  }

  /// Null stands for a filter that lets all pass.
  void compareOverlapping(const double* box, bool isUnfiltered) {
    allpairs_ids ids{};
    const bool isFine = m_world != nullptr && std::none_of(box, box + 6, [](double x) { return std::isnan(x); });
    const allpairs_status status =
        checked(allpairs_world_find_overlapping(m_world, box, isUnfiltered ? nullptr : &m_filter, &ids));
    require((status == ALLPAIRS_OK) == isFine, "a box of numbers can be asked for");
    if (!isFine) return;
    const QueryFilter wanted = isUnfiltered ? QueryFilter{.world = m_wanted.world} : m_wanted;
    requireEqual(ids, m_oracle.overlapping(boxOf(box), wanted), isId);
  }

  void compareOverlapping(const allpairs_set* set, std::span<const Box> boxes, bool hasMargins) {
    allpairs_id_lists lists{};
    const allpairs_status status = checked(allpairs_world_find_overlapping_many(m_world, set, &m_filter, &lists));
    requireStatus(status, set != nullptr && !hasMargins, set != nullptr);
    if (status == ALLPAIRS_OK)
      compareLists(lists, boxes.size(), isId, [&](std::size_t i) { return m_oracle.overlapping(boxes[i], m_wanted); });
  }

  void compare(const allpairs_ray& ray) {
    Hits<allpairs_hits> hits{std::vector<allpairs_hit>(1)};
    hits.firstStatus = checked(allpairs_world_find_first(m_world, &ray, &m_filter, hits.first.data()));
    hits.allStatus = checked(allpairs_world_find_all(m_world, &ray, &m_filter, &hits.all));
    compareOne(ray, hits);
  }
  void compare(const allpairs_sweep& sweep) {
    Hits<allpairs_hits> hits{std::vector<allpairs_hit>(1)};
    hits.firstStatus = checked(allpairs_world_sweep_first(m_world, &sweep, &m_filter, hits.first.data()));
    hits.allStatus = checked(allpairs_world_sweep_all(m_world, &sweep, &m_filter, &hits.all));
    compareOne(sweep, hits);
  }
  void compare(const std::vector<allpairs_ray>& rays) {
    Hits<allpairs_hit_lists> hits{std::vector<allpairs_hit>(rays.size())};
    const allpairs_rays queries{rays.data(), rays.size()};
    hits.firstStatus = checked(allpairs_world_find_first_many(m_world, queries, &m_filter, hits.first.data()));
    hits.allStatus = checked(allpairs_world_find_all_many(m_world, queries, &m_filter, &hits.all));
    compareMany(rays, hits);
  }
  void compare(const std::vector<allpairs_sweep>& sweeps) {
    Hits<allpairs_hit_lists> hits{std::vector<allpairs_hit>(sweeps.size())};
    const allpairs_sweeps queries{sweeps.data(), sweeps.size()};
    hits.firstStatus = checked(allpairs_world_sweep_first_many(m_world, queries, &m_filter, hits.first.data()));
    hits.allStatus = checked(allpairs_world_sweep_all_many(m_world, queries, &m_filter, &hits.all));
    compareMany(sweeps, hits);
  }

  void compareNearest(const allpairs_nearest& nearest) {
    allpairs_neighbors found{};
    const allpairs_status status = checked(allpairs_world_find_nearest(m_world, &nearest, &m_filter, &found));
    require((status == ALLPAIRS_OK) == (m_world != nullptr && areFinite(nearest.point)), "a point is finite");
    const std::array<double, 3> point{nearest.point[0], nearest.point[1], nearest.point[2]};
    if (status == ALLPAIRS_OK) requireEqual(found, m_oracle.nearest(point, nearest.count, m_wanted), isNeighbor);
  }

  void compareNearest(const std::vector<double>& points, std::size_t count) {
    allpairs_neighbor_lists lists{};
    const allpairs_nearest_many nearest{points.data(), points.size() / 3, count};
    const allpairs_status status = checked(allpairs_world_find_nearest_many(m_world, &nearest, &m_filter, &lists));
    requireStatus(status, areFinite(points), areFinite(points));
    if (status != ALLPAIRS_OK) return;
    compareLists(lists, points.size() / 3, isNeighbor, [&](std::size_t i) {
      return m_oracle.nearest(std::array{points[3 * i], points[3 * i + 1], points[3 * i + 2]}, count, m_wanted);
    });
  }

  void compareNearest(const allpairs_nearest_to_boxes& nearest, std::span<const Box> boxes, bool hasMargins) {
    allpairs_neighbor_lists lists{};
    const allpairs_status status = checked(allpairs_world_find_nearest_to_boxes(m_world, &nearest, &m_filter, &lists));
    requireStatus(status, nearest.boxes != nullptr && !hasMargins, nearest.boxes != nullptr);
    if (status != ALLPAIRS_OK) return;
    compareLists(lists, boxes.size(), isNeighbor,
                 [&](std::size_t i) { return m_oracle.nearest(boxes[i], nearest.count, m_wanted); });
  }

 private:
  /// A status of a query that must succeed, may, or must not.
  void requireStatus(allpairs_status status, bool must, bool may) const {
    require(status == ALLPAIRS_OK || m_world == nullptr || !must, "a query that makes sense is answered");
    require(status != ALLPAIRS_OK || (m_world != nullptr && may), "one that makes none is not");
  }

  template <class Found, class Expected, class Same>
  static void requireEqual(const Found& found, const Expected& expected, Same same) {
    require(std::equal(found.data, found.data + found.count, expected.begin(), expected.end(), same),
            "a query gives what the double loop gives");
  }

  template <class Lists, class Same, class Expected>
  static void compareLists(const Lists& lists, std::size_t count, Same same, const Expected& expectedOf) {
    require(lists.count == count, "each query of many has a list");
    for (std::size_t i = 0; i < count; ++i) {
      const auto expected = expectedOf(i);
      require(std::equal(lists.data + lists.offsets[i], lists.data + lists.offsets[i + 1], expected.begin(),
                         expected.end(), same),
              "each of many queries gives what the double loop gives");
    }
  }

  static void requireFirst(const allpairs_hit& first, const std::vector<SweepHit>& expected) {
    require(first.id == (expected.empty() ? ALLPAIRS_NO_BOX : expected.front().id) &&
                (expected.empty() || first.t == expected.front().t),
            "the first hit is that of the double loop");
  }

  template <class Query>
  void compareOne(const Query& query, const Hits<allpairs_hits>& hits) {
    requireStatus(hits.firstStatus, isSound(query), true);
    require(hits.firstStatus == hits.allStatus, "all hits are found where the first one is");
    if (hits.allStatus != ALLPAIRS_OK) return;
    const std::vector<SweepHit> expected = m_oracle.along(sweepOf(query), m_wanted);
    requireEqual(hits.all, expected, isHit);
    requireFirst(hits.first.front(), expected);
  }

  template <class Query>
  void compareMany(const std::vector<Query>& queries, const Hits<allpairs_hit_lists>& hits) {
    const bool areSound =
        std::all_of(queries.begin(), queries.end(), [](const Query& query) { return isSound(query); });
    requireStatus(hits.firstStatus, areSound, true);
    require(hits.firstStatus == hits.allStatus, "all hits of many are found where the first ones are");
    if (hits.allStatus != ALLPAIRS_OK) return;
    compareLists(hits.all, queries.size(), isHit, [&](std::size_t i) {
      const std::vector<SweepHit> expected = m_oracle.along(sweepOf(queries[i]), m_wanted);
      requireFirst(hits.first[i], expected);
      return expected;
    });
  }

  allpairs_world* m_world;
  allpairs_query_filter m_filter;
  QueryFilter m_wanted;
  test::WorldOracle m_oracle;
};

/// The pairs of two worlds are those of the double loop. Whether `accept` passes them is asked of the first.
inline void compareBetween(const CWorld& first, const CWorld& second, bool givesNull) {
  allpairs_pairs pairs{};
  const allpairs_status status =
      checked(allpairs_world_find_between(first.world, second.world, givesNull ? nullptr : &pairs));
  const bool isFine = first.world != nullptr && second.world != nullptr && !givesNull;
  require(status != ALLPAIRS_OK || isFine, "no handle is an invalid argument");
  require(status == ALLPAIRS_OK || !isFine || first.world == second.world, "pairs of two worlds are found");
  if (status != ALLPAIRS_OK) return;
  const test::WorldOracle a = oracleOf(first);
  const test::WorldOracle b = oracleOf(second);
  const double distance = std::midpoint(first.distance, second.distance);  // Never overflows.
  std::vector<Pair> expected;
  for (const auto& [i, one] : a.boxes) {
    BoxProperties p = one.properties;
    p.isStatic = false;  // Static boxes of two worlds meet.
    for (const auto& [j, other] : b.boxes) {
      const double d = distance + p.margin + other.properties.margin;
      if (test::WorldOracle::apart(one.box, other.box, d) || !test::WorldOracle::mayPair(p, other.properties)) continue;
      if (!first.accepts || acceptSome(first.context, i, j)) expected.push_back({i, j});
    }
  }
  std::sort(expected.begin(), expected.end(), [&a](Pair x, Pair y) { return a.isBefore(x, y); });
  require(std::equal(pairs.data, pairs.data + pairs.count, expected.begin(), expected.end(),
                     [](const allpairs_pair& x, Pair y) { return x.first == y.first && x.second == y.second; }),
          "pairs of two worlds are those of the double loop");
}

}  // namespace allpairs::fuzz
