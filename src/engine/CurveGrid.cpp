// SPDX-License-Identifier: MIT
#include "CurveGrid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace allpairs::engine {
namespace {

constexpr std::size_t kSampleSize = 256;

/// A box is large if it is this many times as long as the median one. Measured: 4 to 8 are equally good.
constexpr float kLargeFactor = 6.0F;

/// A large box is long if its longest side is this many times the next one.
constexpr float kLongFactor = 3.0F;

/// Sample widths beyond this many times the middle four fifths are taken for outliers.
constexpr float kOutlierFactor = 64.0F;

/// The bits of a number below 2^kMaxBitsPerAxis, each moved to three times its place.
struct SpreadTable {
  std::array<std::uint32_t, std::size_t{1} << CurveGrid::kMaxBitsPerAxis> value{};

  constexpr SpreadTable() {
    for (std::uint32_t i = 0; i < value.size(); ++i) {
      for (unsigned bit = 0; bit < CurveGrid::kMaxBitsPerAxis; ++bit) value[i] |= ((i >> bit) & 1U) << (3 * bit);
    }
  }
};

constexpr SpreadTable kSpread;

/// Half of each bound first: their sum may be too large for a float32.
float centre(const LaneBox& box, std::size_t axis) { return 0.5F * box.bound[axis] + 0.5F * box.bound[axis + 3]; }

/// About one more bit an axis than it takes to give each box a cell of its own.
unsigned bitsFor(std::size_t size) {
  const auto log2 = static_cast<unsigned>(std::bit_width(size));
  return std::clamp((log2 + 2) / 3 + 1, 2U, CurveGrid::kMaxBitsPerAxis);
}

}  // namespace

struct CurveGrid::Sample {
  std::size_t size = 0;
  std::array<std::array<float, kSampleSize>, 3> centres;
  std::array<float, kSampleSize> extents;

  void take(const LaneBox& box) {
    float longest = 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centres[axis][size] = centre(box, axis);
      longest = std::max(longest, box.bound[axis + 3] - box.bound[axis]);
    }
    extents[size++] = longest;
  }
};

CurveGrid::CurveGrid(const LaneReader& reader) : m_bits(bitsFor(reader.size())) {
  Sample sample;
  const std::size_t count = std::min(reader.size(), kSampleSize);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = i * reader.size() / count;
    static_cast<void>(reader.read(
        index, index + 1, [&](std::size_t, const LaneBox& box) { sample.take(box); }, [](std::size_t) {}));
  }
  if (sample.size == 0) return;
  for (std::size_t axis = 0; axis < 3; ++axis) fitAxis(axis, sample);
  const float cells = static_cast<float>(1U << m_bits);
  m_lastCell = cells - 1.0F;
  m_scale = m_width > 0.0F ? cells / m_width : 0.0F;
  const auto middle = sample.extents.begin() + static_cast<std::ptrdiff_t>(sample.size / 2);
  std::nth_element(sample.extents.begin(), middle, sample.extents.begin() + static_cast<std::ptrdiff_t>(sample.size));
  m_largeExtent = kLargeFactor * *middle;
}

void CurveGrid::fitAxis(std::size_t axis, Sample& sample) {
  const auto begin = sample.centres[axis].begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(sample.size);
  std::sort(begin, end);
  const float tenth = begin[static_cast<std::ptrdiff_t>(sample.size / 10)];
  const float middle = begin[static_cast<std::ptrdiff_t>(sample.size - 1 - sample.size / 10)] - tenth;
  float least = *begin;
  float width = *(end - 1) - least;
  if (middle > 0.0F && width > kOutlierFactor * middle) {
    least = tenth - middle;
    width = 3.0F * middle;
  }
  m_origin[axis] = least;
  m_width = std::max(m_width, std::min(width, kLaneMax));
}

std::uint32_t CurveGrid::cell(const LaneBox& box, std::size_t axis) const noexcept {
  const float position = (centre(box, axis) - m_origin[axis]) * m_scale;
  // Written so that a NaN, of an infinite distance times a scale of 0, goes to cell 0.
  return position > 0.0F ? static_cast<std::uint32_t>(std::min(position, m_lastCell)) : 0U;
}

std::uint32_t CurveGrid::sizeClass(const std::array<float, 3>& extent, float longest) const noexcept {
  std::array<float, 3> sorted = extent;
  std::sort(sorted.begin(), sorted.end());
  if (longest > kLongFactor * sorted[1]) {
    return 1U + static_cast<std::uint32_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  }
  if (longest <= 8.0F * m_largeExtent) return 4U;
  return longest <= 64.0F * m_largeExtent ? 5U : 6U;
}

std::uint32_t CurveGrid::key(const LaneBox& box) const noexcept {
  const std::uint32_t code =
      kSpread.value[cell(box, 0)] | kSpread.value[cell(box, 1)] << 1U | kSpread.value[cell(box, 2)] << 2U;
  const std::array<float, 3> extent{box.bound[3] - box.bound[0], box.bound[4] - box.bound[1],
                                    box.bound[5] - box.bound[2]};
  const float longest = std::max({extent[0], extent[1], extent[2]});
  if (longest <= m_largeExtent) return code;
  return code | sizeClass(extent, longest) << (3 * m_bits);
}

}  // namespace allpairs::engine
