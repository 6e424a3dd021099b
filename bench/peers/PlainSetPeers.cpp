// SPDX-License-Identifier: MIT
// What a user writes without a library, compiled for the processor at hand: the double loop, and sorting along one
// axis.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "SetPeer.h"

namespace allpairs::bench {

namespace {

template <class T>
class LoopOfSets final : public SetSearch<T> {
 public:
  std::span<const Pair> find(const Sets<T>& sets) override {
    clear();
    const std::span<const T> others = sets.areTwo ? sets.second : sets.first;
    const auto count = static_cast<std::uint32_t>(sets.first.size() / 6);
    const auto end = static_cast<std::uint32_t>(others.size() / 6);
    for (std::uint32_t i = 0; i < count; ++i) {
      const T* const box = sets.first.data() + 6 * std::size_t{i};
      for (std::uint32_t j = sets.areTwo ? 0 : i + 1; j < end; ++j) {
        if (boxesOverlap(box, others.data() + 6 * std::size_t{j})) m_pairs.push_back({i, j});
      }
    }
    return m_pairs;
  }

  void clear() override { m_pairs = std::vector<Pair>(); }

 private:
  std::vector<Pair> m_pairs;
};

/// A box in the order of its lower bounds on the axis.
template <class T>
struct SweptBox {
  std::array<T, 6> bounds;
  std::uint32_t number;
};

/// How far the centres of boxes are spread on each axis, in extents of a box: where that is most, sweeping tests least.
template <class T>
class Spread {
 public:
  explicit Spread(std::span<const T> rows) { add(rows); }

  void add(std::span<const T> rows) {
    for (std::size_t row = 0; row < rows.size(); row += 6) {
      for (std::size_t axis = 0; axis < 3; ++axis) addTo(m_axes[axis], rows[row + axis], rows[row + axis + 3]);
    }
    m_count += static_cast<double>(rows.size()) / 6.0;
  }

  [[nodiscard]] std::size_t bestAxis() const {
    std::array<double, 3> spreads{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Sums& sums = m_axes[axis];
      const double variance =
          std::max(sums.squares / m_count - (sums.centres / m_count) * (sums.centres / m_count), 0.0);
      spreads[axis] = variance == 0.0 ? 0.0 : variance / (sums.extents * sums.extents);
    }
    return static_cast<std::size_t>(std::max_element(spreads.begin(), spreads.end()) - spreads.begin());
  }

 private:
  struct Sums {
    double centres = 0.0;
    double squares = 0.0;
    double extents = 0.0;
    double origin = 0.0;  // Of the first box, so that squares of what is far from 0 keep their digits.
    bool any = false;
  };

  static void addTo(Sums& sums, T low, T high) {
    const double centre = 0.5 * (static_cast<double>(low) + static_cast<double>(high));
    if (!sums.any) sums.origin = centre;
    sums.any = true;
    sums.centres += centre - sums.origin;
    sums.squares += (centre - sums.origin) * (centre - sums.origin);
    sums.extents += static_cast<double>(high) - static_cast<double>(low);
  }

  std::array<Sums, 3> m_axes{};
  double m_count = 0.0;
};

template <class T>
std::vector<SweptBox<T>> sortedAlong(std::size_t axis, std::span<const T> rows) {
  struct Key {
    T low;
    std::uint32_t number;
  };
  std::vector<Key> keys(rows.size() / 6);
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = {rows[6 * i + axis], static_cast<std::uint32_t>(i)};
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.low < b.low; });
  std::vector<SweptBox<T>> boxes(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::copy_n(rows.data() + 6 * std::size_t{keys[i].number}, 6, boxes[i].bounds.begin());
    boxes[i].number = keys[i].number;
  }
  return boxes;
}

template <class T>
class SweepOfSets final : public SetSearch<T> {
 public:
  std::span<const Pair> find(const Sets<T>& sets) override {
    clear();
    Spread<T> spread(sets.first);
    if (sets.areTwo) spread.add(sets.second);
    m_axis = spread.bestAxis();
    m_first = sortedAlong(m_axis, sets.first);
    if (sets.areTwo) m_second = sortedAlong(m_axis, sets.second);
    sets.areTwo ? sweepTwo() : sweepOne();
    return m_pairs;
  }

  void clear() override {
    m_first = {};
    m_second = {};
    m_pairs = {};
  }

 private:
  void sweepOne() {
    for (std::size_t i = 0; i < m_first.size(); ++i) {
      const SweptBox<T>& box = m_first[i];
      visit(box, m_first, i + 1, [&](const SweptBox<T>& other) { m_pairs.push_back({box.number, other.number}); });
    }
  }

  /// Of two sets: each box meets those of the other set that begin later.
  void sweepTwo() {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < m_first.size() && j < m_second.size()) {
      const SweptBox<T>& a = m_first[i];
      const SweptBox<T>& b = m_second[j];
      if (a.bounds[m_axis] <= b.bounds[m_axis]) {
        visit(a, m_second, j, [&](const SweptBox<T>& other) { m_pairs.push_back({a.number, other.number}); });
        ++i;
      } else {
        visit(b, m_first, i, [&](const SweptBox<T>& other) { m_pairs.push_back({other.number, b.number}); });
        ++j;
      }
    }
  }

  template <class Report>
  void visit(const SweptBox<T>& box, const std::vector<SweptBox<T>>& others, std::size_t begin, const Report& report) {
    const T high = box.bounds[m_axis + 3];
    for (std::size_t k = begin; k < others.size() && others[k].bounds[m_axis] <= high; ++k) {
      if (boxesOverlap(box.bounds.data(), others[k].bounds.data())) report(others[k]);
    }
  }

  std::size_t m_axis = 0;
  std::vector<SweptBox<T>> m_first;
  std::vector<SweptBox<T>> m_second;
  std::vector<Pair> m_pairs;
};

}  // namespace

template <class T>
SetPeer<T> plainLoopOfSets() {
  return {"plain loop", {{"array of boxes", [] { return std::make_unique<LoopOfSets<T>>(); }}}};
}

template <class T>
SetPeer<T> plainSweepOfSets() {
  return {"plain sweep", {{"best axis", [] { return std::make_unique<SweepOfSets<T>>(); }}}};
}

template SetPeer<float> plainLoopOfSets<float>();
template SetPeer<double> plainLoopOfSets<double>();
template SetPeer<float> plainSweepOfSets<float>();
template SetPeer<double> plainSweepOfSets<double>();

}  // namespace allpairs::bench
