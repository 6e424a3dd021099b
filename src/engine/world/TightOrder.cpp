// SPDX-License-Identifier: MIT
#include "world/TightOrder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "CurveGrid.h"
#include "Lanes.h"

namespace allpairs::engine {
namespace {

/// Boxes of a run: enough for its blocks to lose the shape of the curve, few enough to be sorted near the processor.
constexpr std::size_t kRun = 4096;

/// How many parts a cut makes.
constexpr std::size_t kParts = 4;

/// Places along an axis that a cut tells apart.
constexpr std::size_t kSteps = 256;

constexpr unsigned kClassShift = 32 + 3 * CurveGrid::kBitsPerAxis;

}  // namespace

/// Sorts along the longest axis, as exactly as a cut needs.
void TightOrder::sortAlong(std::span<Point> points, Point* spare) {
  std::array<float, 3> low = points[0].centre;
  std::array<float, 3> high = low;
  for (const Point& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point.centre[axis]);
      high[axis] = std::max(high[axis], point.centre[axis]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other) {
    if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
  }
  const float origin = low[axis];
  const float extent = high[axis] - origin;
  if (!(extent > 0.0F)) return;
  const auto stepOf = [=](const Point& point) {
    const float place = (point.centre[axis] - origin) / extent * static_cast<float>(kSteps - 1);
    return static_cast<std::size_t>(static_cast<std::int32_t>(place));
  };
  std::array<std::uint32_t, kSteps> next{};
  for (const Point& point : points) ++next[stepOf(point)];
  std::uint32_t begin = 0;
  for (std::uint32_t& place : next) begin += std::exchange(place, begin);
  for (const Point& point : points) spare[next[stepOf(point)]++] = point;
  std::copy_n(spare, points.size(), points.data());
}

// Each level quarters the run.
// NOLINTNEXTLINE(misc-no-recursion)
void TightOrder::cut(std::span<Point> points, Point* spare) {
  if (points.size() <= kFanOut) return;
  std::size_t part = kFanOut;
  while (part * kParts < points.size()) part *= kParts;
  sortAlong(points, spare);
  for (std::size_t begin = 0; begin < points.size(); begin += part) {
    cut(points.subspan(begin, std::min(part, points.size() - begin)), spare);
  }
}

void TightOrder::tighten(std::span<KeyedBox> boxes, const LaneReader& reader, Executor& executor) {
  m_points.require(boxes.size() + boxes.size() / 8 + 1);
  m_spare.require(boxes.size() + boxes.size() / 8 + 1);
  executor.run((boxes.size() + kRun - 1) / kRun, [&](std::size_t run) {
    const std::size_t begin = run * kRun;
    const std::size_t end = std::min(boxes.size(), begin + kRun);
    reader.withLanes([&](const auto& lanesOf) {
      constexpr std::size_t kPrefetchDistance = 16;
      LaneBox lanes;
      for (std::size_t i = begin; i < end; ++i) {
        reader.prefetch(indexOf(boxes[std::min(i + kPrefetchDistance, end - 1)]));
        static_cast<void>(lanesOf(indexOf(boxes[i]), lanes));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          m_points[i].centre[axis] = 0.25F * lanes.bound[axis] + 0.25F * lanes.bound[axis + 3];
        }
        m_points[i].id = indexOf(boxes[i]);
      }
    });
    // Boxes of one class stay together.
    for (std::size_t i = begin; i < end;) {
      std::size_t stop = i + 1;
      while (stop < end && boxes[stop] >> kClassShift == boxes[i] >> kClassShift) ++stop;
      cut({m_points.data() + i, stop - i}, m_spare.data() + i);
      i = stop;
    }
    for (std::size_t i = begin; i < end; ++i) boxes[i] = m_points[i].id;
  });
}

}  // namespace allpairs::engine
