// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Pair.h"
#include "allpairs/WorldTypes.h"

namespace allpairs::test {

/// What a World must hold and answer, by double loops over a map; it shares no code with the engine.
struct WorldOracle {
  struct Entry {
    Box box;
    BoxProperties properties;
  };
  std::map<BoxId, Entry> boxes;
  std::vector<Pair> pairs, began, persisted, ended;
  double distance = 0.0;
  Order order = Order::ByFirst;
  std::optional<std::uint32_t> only;  ///< If set, pairs of this world alone: those that a World lists for it.

  static bool empty(const Box& b) { return b.min[0] > b.max[0] || b.min[1] > b.max[1] || b.min[2] > b.max[2]; }

  static bool apart(const Box& a, const Box& b, double d) {
    bool result = empty(a) || empty(b);
    for (std::size_t k = 0; k < 3; ++k) result = result || a.min[k] > b.max[k] + d || b.min[k] > a.max[k] + d;
    return result;
  }

  static bool mayPair(const BoxProperties& a, const BoxProperties& b) {
    if (a.isStatic && b.isStatic) return false;
    if (a.world != kEveryWorld && b.world != kEveryWorld && a.world != b.world) return false;
    if ((a.category & b.mask) == 0 || (b.category & a.mask) == 0) return false;
    return a.group == 0 || a.group != b.group;
  }

  [[nodiscard]] bool isBefore(const Pair& a, const Pair& b) const {
    return order == Order::BySecond ? std::pair(a.second, a.first) < std::pair(b.second, b.first)
                                    : std::pair(a.first, a.second) < std::pair(b.first, b.second);
  }

  void step() { become(pairsNow()); }

  /// The world that a pair is listed for.
  [[nodiscard]] std::uint32_t worldOf(const Pair& pair) const {
    return std::min(boxes.at(pair.first).properties.world, boxes.at(pair.second).properties.world);
  }

  [[nodiscard]] std::vector<Pair> pairsNow() const {
    std::vector<Pair> now;
    for (auto a = boxes.begin(); a != boxes.end(); ++a) {
      for (auto b = std::next(a); b != boxes.end(); ++b) {
        const double d = distance + a->second.properties.margin + b->second.properties.margin;
        if (apart(a->second.box, b->second.box, d)) continue;
        const std::uint32_t world = std::min(a->second.properties.world, b->second.properties.world);
        if (only && *only != world) continue;
        if (mayPair(a->second.properties, b->second.properties)) now.push_back({a->first, b->first});
      }
    }
    std::sort(now.begin(), now.end(), [this](const Pair& a, const Pair& b) { return isBefore(a, b); });
    return now;
  }

  /// A step that finds these pairs, in order.
  void become(const std::vector<Pair>& now) {
    const auto before = [this](const Pair& a, const Pair& b) { return isBefore(a, b); };
    // Two boxes that had the same id are two boxes: a world must not reuse an id before this step is over.
    began.clear(), persisted.clear(), ended.clear();
    std::set_difference(now.begin(), now.end(), pairs.begin(), pairs.end(), std::back_inserter(began), before);
    std::set_intersection(now.begin(), now.end(), pairs.begin(), pairs.end(), std::back_inserter(persisted), before);
    std::set_difference(pairs.begin(), pairs.end(), now.begin(), now.end(), std::back_inserter(ended), before);
    pairs = now;
  }

  static bool looksAt(const BoxProperties& p, const QueryFilter& f) {
    if (f.world != kEveryWorld && p.world != kEveryWorld && p.world != f.world) return false;
    return (p.category & f.mask) != 0 && (p.mask & f.category) != 0 && (p.isStatic ? f.staticBoxes : f.dynamicBoxes);
  }

  [[nodiscard]] std::vector<BoxId> overlapping(const Box& query, const QueryFilter& filter) const {
    std::vector<BoxId> result;
    for (const auto& [id, e] : boxes) {
      if (looksAt(e.properties, filter) && !apart(e.box, query, e.properties.margin)) result.push_back(id);
    }
    return result;
  }

  /// The bounds with the margin added; an infinite margin reaches everywhere.
  static double lowOf(const Entry& e, std::size_t k) {
    const double infinity = std::numeric_limits<double>::infinity();
    return e.properties.margin == infinity ? -infinity : e.box.min[k] - e.properties.margin;
  }
  static double highOf(const Entry& e, std::size_t k) {
    const double infinity = std::numeric_limits<double>::infinity();
    return e.properties.margin == infinity ? infinity : e.box.max[k] + e.properties.margin;
  }

  /// By the greatest component, which is made 0.5 to 1 where squares would overflow or vanish.
  static double length(const std::array<double, 3>& v) {
    const double sum = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const double most = std::max({v[0], v[1], v[2]});
    if ((sum > 1e-280 && std::isfinite(sum)) || most == 0.0 || !std::isfinite(most)) return std::sqrt(sum);
    int exponent = 0;
    std::frexp(most, &exponent);
    double scaled = 0.0;
    for (const double gap : v) scaled += std::ldexp(gap, -exponent) * std::ldexp(gap, -exponent);
    return std::ldexp(std::sqrt(scaled), exponent);
  }

  /// When a swept box meets a box: each axis says when it does, and all must at once.
  static double meeting(const BoxSweep& s, const Entry& e) {
    double from = 0.0;
    double to = s.length;
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = lowOf(e, k);
      const double high = highOf(e, k);
      if (s.motion[k] == 0.0) {
        if (low > s.box.max[k] || high < s.box.min[k]) return std::numeric_limits<double>::infinity();
      } else {
        const double t1 = (low - s.box.max[k]) / s.motion[k];
        const double t2 = (high - s.box.min[k]) / s.motion[k];
        // A difference of infinities, of bounds that are equal, says nothing of t.
        from = std::fmax(from, s.motion[k] > 0.0 ? t1 : t2);
        to = std::fmin(to, s.motion[k] > 0.0 ? t2 : t1);
      }
    }
    return from <= to ? from : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] std::vector<SweepHit> along(const BoxSweep& sweep, const QueryFilter& filter) const {
    std::vector<SweepHit> result;
    for (const auto& [id, e] : boxes) {
      if (!looksAt(e.properties, filter) || empty(e.box) || empty(sweep.box)) continue;
      const double t = meeting(sweep, e);
      if (t != std::numeric_limits<double>::infinity()) result.push_back({id, t});
    }
    std::stable_sort(result.begin(), result.end(), [](const SweepHit& a, const SweepHit& b) { return a.t < b.t; });
    return result;
  }

  [[nodiscard]] std::vector<Neighbor> nearest(const std::array<double, 3>& p, std::size_t count,
                                              const QueryFilter& filter) const {
    return nearest(Box{p, p}, count, filter);
  }

  [[nodiscard]] std::vector<Neighbor> nearest(const Box& query, std::size_t count, const QueryFilter& filter) const {
    std::vector<Neighbor> result;
    if (empty(query)) return result;
    for (const auto& [id, e] : boxes) {
      if (!looksAt(e.properties, filter) || empty(e.box)) continue;
      std::array<double, 3> gaps{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (lowOf(e, k) > query.max[k]) gaps[k] = lowOf(e, k) - query.max[k];
        if (query.min[k] > highOf(e, k)) gaps[k] = std::max(gaps[k], query.min[k] - highOf(e, k));
      }
      result.push_back({id, length(gaps)});
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const Neighbor& a, const Neighbor& b) { return a.distance < b.distance; });
    if (result.size() > count) result.resize(count);
    return result;
  }
};

}  // namespace allpairs::test
