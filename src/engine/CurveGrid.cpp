// SPDX-License-Identifier: MIT
#include "CurveGrid.h"

#include <algorithm>
#include <bit>
#include <span>

#include "Sampling.h"

namespace allpairs::engine {
namespace {

constexpr std::size_t kMostSamples = 256;

/// A box is large if it is this many times as long as the median one.
constexpr float kLargeFactor = 6.0F;

/// A large box is long if its longest side is this many times the next one.
constexpr float kLongFactor = 3.0F;

/// Sample widths beyond this many times the middle four fifths are taken for outliers.
constexpr float kOutlierFactor = 64.0F;

/// Centres and longest sides of some boxes.
struct Sample {
  std::size_t size = 0;
  std::array<std::array<float, kMostSamples>, 3> centres;
  std::array<float, kMostSamples> extents;

  void take(const LaneBox& box) {
    float longest = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centres[axis][size] = 0.5F * box.bound[axis] + 0.5F * box.bound[axis + 3];
      longest = std::max(longest, box.bound[axis + 3] - box.bound[axis]);
    }
    extents[size++] = longest;
  }
};

/// About a sixteenth of the boxes, so that sampling costs nothing to speak of.
std::size_t sampleSize(std::size_t boxes) {
  return std::min(boxes, std::clamp<std::size_t>(boxes / 16, 32, kMostSamples));
}

/// As many cells as boxes, and then four times as many along each axis, for sets that are crowded in places.
unsigned bitsFor(std::size_t boxes) {
  return std::min((static_cast<unsigned>(std::bit_width(boxes)) + 2) / 3 + 1, CurveGrid::kMaxBitsPerAxis);
}

struct Range {
  float least;
  float width;
};

float nth(std::span<float> values, std::size_t n) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Where most of the values are: all of them, unless a few are very far away.
Range rangeOf(std::span<float> values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const Range all{*least, std::min(*greatest - *least, kLaneMax)};
  const std::size_t tenth = values.size() / 10;
  const float low = nth(values, tenth);
  const float middle = nth(values, values.size() - 1 - tenth) - low;
  if (middle > 0.0F && all.width > kOutlierFactor * middle) return {low - middle, 3.0F * middle};
  return all;
}

/// The grid for so many boxes of which these are some.
CurveGrid fitTo(Sample& sample, std::size_t boxes) {
  CurveGrid grid;
  if (sample.size == 0) return grid;
  std::array<float, 3> widths;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Range range = rangeOf({sample.centres[axis].data(), sample.size});
    grid.origin[axis] = range.least;
    widths[axis] = range.width;
  }
  const auto isNarrower = [&](std::uint32_t a, std::uint32_t b) {
    return widths[a] < widths[b] || (widths[a] == widths[b] && a < b);
  };
  std::sort(grid.axes.begin(), grid.axes.end(), isNarrower);
  const float width = widths[grid.axes[2]];
  grid.bitsPerAxis = bitsFor(boxes);
  const auto cells = static_cast<float>(1U << grid.bitsPerAxis);
  if (width > 0.0F) grid.scale = std::min(cells / width, kLaneMax);
  grid.largeExtent = kLargeFactor * nth({sample.extents.data(), sample.size}, sample.size / 2);
  return grid;
}

}  // namespace

CurveGrid CurveGrid::fit(const LaneReader& reader) {
  Sample sample;
  sampleBoxes(reader, sampleSize(reader.size()), [&](const LaneBox& box) { sample.take(box); });
  return fitTo(sample, reader.size());
}

CurveGrid CurveGrid::fit(const LaneReader& reader, std::span<const KeyedBox> boxes) {
  Sample sample;
  const std::size_t size = sampleSize(boxes.size());
  reader.withLanes([&](const auto& lanesOf) {
    LaneBox lanes;
    for (std::size_t part = 0; part < size; ++part) {
      static_cast<void>(lanesOf(indexOf(boxes[sampleIndex(part, size, boxes.size())]), lanes));
      sample.take(lanes);
    }
  });
  return fitTo(sample, boxes.size());
}

std::uint32_t CurveGrid::classOf(const LaneBox& box) const noexcept {
  const std::array<float, 3> extent{box.bound[3] - box.bound[0], box.bound[4] - box.bound[1],
                                    box.bound[5] - box.bound[2]};
  std::array<float, 3> sorted = extent;
  std::sort(sorted.begin(), sorted.end());
  if (sorted[2] > kLongFactor * sorted[1]) {
    return 1U + static_cast<std::uint32_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  }
  if (sorted[2] <= 8.0F * largeExtent) return 4U;
  return sorted[2] <= 64.0F * largeExtent ? 5U : 6U;
}

}  // namespace allpairs::engine
