// SPDX-License-Identifier: MIT
// Random boxes of every awkward kind, against the double loop. RapidCheck prints the seed and the smallest failing
// case.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include "allpairs/Overlaps.h"
#include "support/AnyBoxes.h"
#include "support/Boxes.h"
#include "support/Oracle.h"
#include "support/Strategies.h"

namespace allpairs {
namespace {

using test::anyBox;
using test::distance;
using test::extremeBox;
using test::scene;

OverlapOptions optionsWith(Strategy strategy, double d) {
  OverlapOptions options;
  options.strategy = strategy;
  options.distance = d;
  return options;
}

using test::kStrategies;

void showBoxes(const std::vector<Box>& boxes) {
  RC_CLASSIFY(boxes.size() > 16, "more than a block");
  RC_CLASSIFY(boxes.size() > 64, "more than four blocks");
}

RC_GTEST_PROP(OverlapsProperty, AnyBoxesAtAnyDistanceGiveTheOraclesPairs, ()) {
  const auto boxes = *scene();
  const double d = *distance();
  showBoxes(boxes);
  const std::vector<Pair> expected = test::oracle(boxes, d);
  for (const Strategy strategy : kStrategies) RC_ASSERT(overlaps(boxes, optionsWith(strategy, d)) == expected);
}

RC_GTEST_PROP(OverlapsProperty, AnyFloat32BoxesGiveTheOraclesPairs, ()) {
  const std::vector<BoxF> boxes = test::toFloat32(*scene());
  const double d = *distance();
  const std::vector<Pair> expected = test::oracle(test::toDouble(boxes), d);
  for (const Strategy strategy : kStrategies) RC_ASSERT(overlaps(boxes, optionsWith(strategy, d)) == expected);
}

template <class Boxes>
void testExtremes(const Boxes& boxes, const Boxes& others) {
  const double d = *distance();
  const auto exact = [](const Boxes& of) {
    if constexpr (std::is_same_v<Boxes, std::vector<Box>>)
      return of;
    else
      return test::toDouble(of);
  };
  const std::vector<Pair> expected = test::oracle(exact(boxes), d);
  const std::vector<Pair> between = test::oracleBetween(exact(boxes), exact(others), d);
  for (const Strategy strategy : kStrategies) {
    RC_ASSERT(overlaps(boxes, optionsWith(strategy, d)) == expected);
    RC_ASSERT(overlaps(boxes, others, optionsWith(strategy, d)) == between);
    RC_ASSERT(countOverlaps(boxes, optionsWith(strategy, d)) == expected.size());
  }
}

/// A box from infinity to the largest number is empty, though it is a point in float32.
RC_GTEST_PROP(OverlapsProperty, BoxesAtTheEndOfTheNumbersGiveTheOraclesPairs, ()) {
  const auto most = *rc::gen::element<std::size_t>(4, 40, 400);
  const auto boxes = *rc::gen::container<std::vector<Box>>(*rc::gen::inRange<std::size_t>(0, most), extremeBox());
  const auto others = *rc::gen::container<std::vector<Box>>(*rc::gen::inRange<std::size_t>(0, most), extremeBox());
  testExtremes(boxes, others);
  testExtremes(test::toFloat32(boxes), test::toFloat32(others));
}

RC_GTEST_PROP(OverlapsProperty, BoxesFarFromTheOriginGiveTheOraclesPairs, ()) {
  auto boxes = *scene();
  auto others = *scene();
  const double place = *rc::gen::element(1e3, -1e7, 1.0 / 3.0 * 1e9, 0x1p52, -1e15, 1e30, 3.4e38, 1e300);
  for (std::vector<Box>* set : {&boxes, &others}) {
    for (Box& box : *set) {
      box.min[0] += place;
      box.max[0] += place;
      box.min[2] -= 3.0 * place;
      box.max[2] -= 3.0 * place;
    }
  }
  const std::vector<Pair> expected = test::oracle(boxes);
  const std::vector<Pair> between = test::oracleBetween(boxes, others);
  for (const Strategy strategy : kStrategies) {
    RC_ASSERT(overlaps(boxes, optionsWith(strategy, 0.0)) == expected);
    RC_ASSERT(overlaps(boxes, others, optionsWith(strategy, 0.0)) == between);
  }
}

/// Margins and distances as large as the coordinates, which cancel them, beside usual ones.
RC_GTEST_PROP(OverlapsProperty, WidenedBoxesFarFromTheOriginGiveTheOraclesPairs, ()) {
  auto boxes = *scene();
  const double place = *rc::gen::element(1.0, -0.5, 1e3, -1e7, 0x1p52, -1e15, 1e30, 3.4e38, 1e300, 1.7e308);
  const double otherPlace = *rc::gen::element(place, -place);
  for (Box& box : boxes) {
    const double at = &box == &boxes.back() ? otherPlace : place;
    box.min[0] += at;
    box.max[0] += at;
    box.min[1] -= 0.5 * place;
    box.max[1] -= 0.5 * place;
  }
  const auto large = rc::gen::element(0.0, std::abs(place), 2.0 * std::abs(place), 0.6 * std::abs(place));
  const auto reach = rc::gen::weightedOneOf<double>({{2, large}, {3, distance()}});
  const double d = *reach;
  const auto margins = *rc::gen::container<std::vector<double>>(boxes.size(), reach);
  BoxView set(boxes);
  for (const Strategy strategy : kStrategies)
    RC_ASSERT(overlaps(set, optionsWith(strategy, d)) == test::oracle(boxes, d));
  set.setMargins(margins);
  const std::vector<Pair> expected = test::oracle(boxes, d, margins);
  for (const Strategy strategy : kStrategies) RC_ASSERT(overlaps(set, optionsWith(strategy, d)) == expected);
}

/// The boxes in every layout that the readers tell apart, each in memory of its own without anything behind it.
template <class T>
struct Layouts {
  explicit Layouts(const std::vector<Box>& boxes) : size(boxes.size()) {
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto lo = static_cast<T>(boxes[i].min[axis]);
        const auto hi = static_cast<T>(boxes[i].max[axis]);
        min.push_back(lo);
        max.push_back(hi);
      }
    }
    rows = spread(6, 3);
    padded = spread(8, 4);
    mixed = std::vector<T>(2 * min.size());
    minColumns = maxColumns = std::vector<T>(min.size());
    for (std::size_t k = 0; k < min.size(); ++k) {
      mixed[2 * k] = min[k];
      minColumns[k % 3 * size + k / 3] = min[k];
      maxColumns[k % 3 * size + k / 3] = max[k];
    }
    if (!mixed.empty()) mixed.pop_back();
  }

  /// Rows of `stride` values, the last of which ends with its maximum, which is `second` after the minimum.
  [[nodiscard]] std::vector<T> spread(std::size_t stride, std::size_t second) const {
    std::vector<T> result(size == 0 ? 0 : (size - 1) * stride + second + 3, std::numeric_limits<T>::quiet_NaN());
    for (std::size_t k = 0; k < min.size(); ++k) {
      result[k / 3 * stride + k % 3] = min[k];
      result[k / 3 * stride + second + k % 3] = max[k];
    }
    return result;
  }

  [[nodiscard]] std::vector<BoxView> views() const {
    if (size == 0) return {BoxView()};
    const auto n = static_cast<std::ptrdiff_t>(size);
    return {BoxView::fromRows(rows), BoxView::fromCorners(min, max),
            BoxView::fromStrided(size, CornerView<T>{padded.data(), 8, 1}, {padded.data() + 4, 8, 1}),
            BoxView::fromStrided(size, CornerView<T>{minColumns.data(), 1, n}, {maxColumns.data(), 1, n}),
            BoxView::fromStrided(size, CornerView<T>{mixed.data(), 6, 2}, {max.data(), 3, 1})};
  }

  [[nodiscard]] std::vector<BoxView> reversedViews() const {
    if (size == 0) return {BoxView()};
    const auto last = static_cast<std::ptrdiff_t>(3 * (size - 1));
    return {BoxView::fromStrided(size, CornerView<T>{min.data() + last, -3, 1}, {max.data() + last, -3, 1}),
            BoxView::fromStrided(size, CornerView<T>{mixed.data() + 2 * last, -6, 2}, {max.data() + last, -3, 1})};
  }

  std::size_t size;
  std::vector<T> min, max, rows, padded, minColumns, maxColumns, mixed;
};

template <class T>
void testLayouts() {
  const auto boxes = *scene();
  const double d = *distance();
  std::vector<Box> exact;
  for (const Box& box : boxes) {
    Box& rounded = exact.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rounded.min[axis] = static_cast<double>(static_cast<T>(box.min[axis]));
      rounded.max[axis] = static_cast<double>(static_cast<T>(box.max[axis]));
    }
  }
  const auto margins = *rc::gen::container<std::vector<double>>(boxes.size(), distance());
  const Layouts<T> layouts(boxes);
  const auto test = [&](BoxView view, const std::vector<double>& of) {
    const std::vector<Pair> plain = test::oracle(exact, d);
    const std::vector<Pair> wide = test::oracle(exact, d, of);
    for (const Strategy strategy : kStrategies) {
      view.setMargins({});
      RC_ASSERT(overlaps(view, optionsWith(strategy, d)) == plain);
      view.setMargins(of);
      RC_ASSERT(overlaps(view, optionsWith(strategy, d)) == wide);
    }
  };
  for (const BoxView& view : layouts.views()) test(view, margins);
  std::reverse(exact.begin(), exact.end());
  const std::vector<double> reversed(margins.rbegin(), margins.rend());
  for (const BoxView& view : layouts.reversedViews()) test(view, reversed);
}

RC_GTEST_PROP(OverlapsProperty, AnyLayoutOfFloat32GivesTheOraclesPairs, ()) { testLayouts<float>(); }
RC_GTEST_PROP(OverlapsProperty, AnyLayoutOfFloat64GivesTheOraclesPairs, ()) { testLayouts<double>(); }

RC_GTEST_PROP(OverlapsProperty, AnyMarginsGiveTheOraclesPairs, ()) {
  const auto boxes = *scene();
  const auto margins = *rc::gen::container<std::vector<double>>(boxes.size(), distance());
  const double d = *distance();
  BoxView set(boxes);
  set.setMargins(margins);
  const std::vector<Pair> expected = test::oracle(boxes, d, margins);
  for (const Strategy strategy : kStrategies) RC_ASSERT(overlaps(set, optionsWith(strategy, d)) == expected);
}

RC_GTEST_PROP(OverlapsProperty, TwoSetsGiveTheOraclesPairs, ()) {
  const auto first = *scene();
  const auto second = *scene();
  const double d = *distance();
  const std::vector<Pair> expected = test::oracleBetween(first, second, d);
  for (const Strategy strategy : kStrategies) {
    RC_ASSERT(overlaps(first, second, optionsWith(strategy, d)) == expected);
    RC_ASSERT(countOverlaps(first, second, optionsWith(strategy, d)) == expected.size());
  }
}

RC_GTEST_PROP(OverlapsProperty, ARegionLeavesOutWhatIsOutsideOfIt, ()) {
  const auto boxes = *scene();
  const double d = *distance();
  const Box region = *rc::gen::suchThat(anyBox(), [](const Box& box) { return !isEmpty(box); });
  // A box meets the region as it would meet another box: the region goes last, and its pairs say who is in.
  std::vector<Box> withRegion = boxes;
  withRegion.push_back(region);
  std::vector<bool> inside(boxes.size());
  for (const Pair& pair : test::oracle(withRegion, d)) {
    if (pair.second == boxes.size()) inside[pair.first] = true;
  }
  std::vector<Pair> expected;
  for (const Pair& pair : test::oracle(boxes, d)) {
    if (inside[pair.first] && inside[pair.second]) expected.push_back(pair);
  }
  for (const Strategy strategy : kStrategies) {
    OverlapOptions options = optionsWith(strategy, d);
    options.region = region;
    RC_ASSERT(overlaps(boxes, options) == expected);
  }
}

}  // namespace
}  // namespace allpairs
