// SPDX-License-Identifier: MIT
#include "bvh/CurveKey.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "input/Sampling.h"

namespace allpairs::engine {
namespace {

/// Boxes that a grid is fitted to at most: quantiles of more differ little.
constexpr std::size_t kMostSamples = 256;

/// A box is large if it is this many times as long as the median one (docs/decisions/0005, allpairs bench
/// power-law -n 100000).
constexpr float kLargeFactor = 6.0F;

/// Values farther out than this many times the width of the middle four fifths are outliers.
constexpr float kOutlierFactor = 64.0F;

/// About a sixteenth of the boxes, so that the cost of sampling is negligible.
std::size_t sampleSize(std::size_t boxes) {
  return std::min(boxes, std::clamp<std::size_t>(boxes / 16, 32, kMostSamples));
}

/// As many cells as boxes, and then four times as many along each axis, for sets with dense regions.
unsigned bitsFor(std::size_t boxes) {
  return std::min((static_cast<unsigned>(std::bit_width(boxes)) + 2) / 3 + 1, CurveGrid::kMaxBitsPerAxis);
}

float longestSide(const LaneBox& box) {
  float longest = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, box.bound[axis + 3] - box.bound[axis]);
  return longest;
}

float nth(std::span<float> values, std::size_t n) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The beginning and the width of the range of most values: of all, unless a few are outliers.
std::pair<float, float> rangeOf(std::span<float> values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const std::pair all{*least, std::min(*greatest - *least, kLaneMax)};
  const std::size_t tenth = values.size() / 10;
  const float low = nth(values, tenth);
  const float middle = nth(values, values.size() - 1 - tenth) - low;
  if (middle > 0.0F && all.second > kOutlierFactor * middle) return {low - middle, 3.0F * middle};
  return all;
}

/// The grid for a set of boxes of which these are a sample.
CurveGrid fitTo(std::span<const LaneBox> sample, std::size_t boxes) {
  CurveGrid grid;
  if (sample.empty()) return grid;
  std::array<float, kMostSamples> memory;
  const std::span<float> values = std::span(memory).first(sample.size());
  std::array<float, 3> widths;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::transform(sample.begin(), sample.end(), values.begin(),
                   [=](const LaneBox& box) { return 0.5F * box.bound[axis] + 0.5F * box.bound[axis + 3]; });
    const auto [least, range] = rangeOf(values);
    grid.origin[axis] = least;
    widths[axis] = range;
  }
  const auto isNarrower = [&](std::uint32_t a, std::uint32_t b) {
    return widths[a] < widths[b] || (widths[a] == widths[b] && a < b);
  };
  std::sort(grid.axes.begin(), grid.axes.end(), isNarrower);
  const float width = widths[grid.axes[2]];
  grid.bitsPerAxis = bitsFor(boxes);
  const auto cells = static_cast<float>(1U << grid.bitsPerAxis);
  if (width > 0.0F) grid.scale = std::min(cells / width, kLaneMax);
  std::transform(sample.begin(), sample.end(), values.begin(), longestSide);
  grid.largeExtent = kLargeFactor * nth(values, values.size() / 2);
  return grid;
}

}  // namespace

CurveGrid fitCurveGrid(const BoxReader& reader) {
  std::array<LaneBox, kMostSamples> sample;
  std::size_t size = 0;
  sampleBoxes(reader, sampleSize(reader.size()), [&](const LaneBox& box) { sample[size++] = box; });
  return fitTo(std::span(sample).first(size), reader.size());
}

CurveGrid fitCurveGrid(const BoxReader& reader, std::span<const CurveKey> boxes) {
  std::array<LaneBox, kMostSamples> sample;
  const std::size_t size = sampleSize(boxes.size());
  LaneBlock block;
  for (std::size_t part = 0; part < size; ++part) {
    const std::uint32_t id = indexOf(boxes[sampleIndex(part, size, boxes.size())]);
    static_cast<void>(reader.read({&id, 0, 1}, block));
    sample[part] = block.get(0);
  }
  return fitTo(std::span(sample).first(size), boxes.size());
}

}  // namespace allpairs::engine
