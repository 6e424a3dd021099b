// SPDX-License-Identifier: MIT
#include "bvh/CurveKey.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
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
constexpr std::size_t kOutlierFactor = 64;

/// About a sixteenth of the boxes, so that the cost of sampling is negligible.
std::size_t sampleSize(std::size_t boxes) {
  return std::min(boxes, std::clamp<std::size_t>(boxes / 16, 32, kMostSamples));
}

/// As many cells as boxes, and then four times as many along each axis, for sets with dense regions.
unsigned bitsFor(std::size_t boxes) {
  return std::min((static_cast<unsigned>(std::bit_width(boxes)) + 2) / 3 + 1, CurveGrid::kMaxBitsPerAxis);
}

/// On a line four cells a box, as many as a float32 can tell apart.
unsigned bitsForLine(std::size_t boxes) { return std::min(static_cast<unsigned>(std::bit_width(boxes)) + 2, 24U); }

float centreOf(const LaneBox& box, std::size_t axis) { return 0.5F * box.bound[axis] + 0.5F * box.bound[axis + 3]; }

/// Whether boxes lie along a straight line, which most often the first ones disprove: each meets it, or is no farther
/// from it than `distance`.
bool areAlongLine(std::span<const LaneBox> boxes, std::size_t widestAxis, float distance) {
  const auto isBefore = [=](const LaneBox& a, const LaneBox& b) {
    return centreOf(a, widestAxis) < centreOf(b, widestAxis);
  };
  const auto [first, last] = std::minmax_element(boxes.begin(), boxes.end(), isBefore);
  const float begin = centreOf(*first, widestAxis);
  const float length = centreOf(*last, widestAxis) - begin;
  return std::all_of(boxes.begin(), boxes.end(), [=](const LaneBox& box) {
    const float share = (centreOf(box, widestAxis) - begin) / length;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float onLine = centreOf(*first, axis) + share * (centreOf(*last, axis) - centreOf(*first, axis));
      const float reach = 0.5F * (box.bound[axis + 3] - box.bound[axis]) + distance;
      if (!(std::abs(centreOf(box, axis) - onLine) <= reach)) return false;
    }
    return true;
  });
}

float nth(std::span<float> values, std::size_t n) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Whether four fifths of the values are in two neighbouring parts of so many as outliers are far away: else there are
/// none.
bool mayHaveOutliers(std::span<const float> values, float least, float width) {
  const float partWidth = width / static_cast<float>(kOutlierFactor);
  if (!(partWidth > 0.0F)) return false;
  const auto last = static_cast<float>(kOutlierFactor - 1);
  std::array<std::size_t, kOutlierFactor> counts{};
  for (const float value : values) ++counts[static_cast<std::size_t>(std::min((value - least) / partWidth, last))];
  for (std::size_t part = 1; part < counts.size(); ++part) {
    if (5 * (counts[part - 1] + counts[part]) >= 4 * values.size()) return true;
  }
  return false;
}

/// The beginning and the width of the range of most values: of all, unless a few are outliers.
std::pair<float, float> rangeOf(std::span<float> values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const std::pair all{*least, std::min(*greatest - *least, kLaneMax)};
  if (!mayHaveOutliers(values, all.first, all.second)) return all;
  const std::size_t tenth = values.size() / 10;
  const float low = nth(values, tenth);
  const float middle = nth(values, values.size() - 1 - tenth) - low;
  if (middle > 0.0F && all.second > static_cast<float>(kOutlierFactor) * middle) return {low - middle, 3.0F * middle};
  return all;
}

/// The grid for a set of boxes of which these are a sample.
CurveGrid fitTo(std::span<const LaneBox> sample, std::size_t boxes) {
  CurveGrid grid;
  if (sample.empty()) return grid;
  std::array<float, kMostSamples> memory;
  const std::span<float> values = std::span(memory).first(sample.size());
  std::array<float, 3> widths;
  float reach = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::transform(sample.begin(), sample.end(), values.begin(),
                   [=](const LaneBox& box) { return centreOf(box, axis); });
    const auto [least, range] = rangeOf(values);
    grid.origin[axis] = least;
    widths[axis] = range;
    reach = std::max(reach, std::abs(least) + range);
  }
  const auto isNarrower = [&](std::uint32_t a, std::uint32_t b) {
    return widths[a] < widths[b] || (widths[a] == widths[b] && a < b);
  };
  std::sort(grid.axes.begin(), grid.axes.end(), isNarrower);
  const float width = widths[grid.axes[2]];
  const float blockLength = width * (static_cast<float>(kFanOut) / static_cast<float>(boxes));
  grid.isLine = areAlongLine(sample, grid.axes[2], blockLength);
  grid.bitsPerAxis = grid.isLine ? bitsForLine(boxes) : bitsFor(boxes);
  const auto cells = static_cast<float>(1U << grid.bitsPerAxis);
  if (width > 0.0F) grid.scale = std::min(cells / width, kLaneMax);
  std::transform(sample.begin(), sample.end(), values.begin(), longestSide);
  // Whether the lanes of tiny boxes are equal or a unit apart says nothing of the boxes.
  const float unit = std::min(reach, kLaneMax) * std::numeric_limits<float>::epsilon();
  grid.largeExtent = kLargeFactor * std::max(nth(values, values.size() / 2), unit);
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
  std::size_t read = 0;
  readSample(
      reader, size, [&](std::size_t part) { return indexOf(boxes[sampleIndex(part, size, boxes.size())]); },
      [&](const LaneBox& box, std::uint32_t /*index*/, bool /*isEmpty*/) { sample[read++] = box; });
  return fitTo(std::span(sample).first(size), boxes.size());
}

}  // namespace allpairs::engine
