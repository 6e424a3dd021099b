// SPDX-License-Identifier: MIT
#include "input/FewValues.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "input/Parts.h"
#include "input/Sampling.h"
#include "kernels/Lanes.h"

namespace allpairs::engine {
namespace {

/// Fewer gain little: of 1,000, unordered, finding the values takes as long as the exact tests (docs/decisions/0041).
constexpr std::size_t kFewestBoxes = 256;

/// The most values of an axis, twice as many as in a square of boxes side by side: of more, few bounds touch, and the
/// table leaves the nearest caches.
std::size_t mostValuesOf(std::size_t boxes) noexcept {
  return std::min(static_cast<std::size_t>(2.0 * std::sqrt(static_cast<double>(boxes))), std::size_t{1} << 13);
}

/// In a table that is at most half full, values are hardly ever so far from the slot that they hash to, unless somebody
/// has chosen them for that.
constexpr std::size_t kMostLooks = 64;

/// The most boxes in a sample.
constexpr std::size_t kMostSampled = 512;

/// Whether a sample of a set has values more than once on each axis; and whether they all are float32. It has either the
/// minimum or the maximum of a box: of a point they are the same.
bool seemFew(const BoxView& boxes, bool& areFloat32) {
  const std::size_t size = std::clamp<std::size_t>(boxes.size() / 32, 32, kMostSampled);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, kMostSampled> sample;
    for (std::size_t i = 0; i < size; ++i) {
      const Box box = boxes[sampleIndex(i, size, boxes.size())];
      sample[i] = i % 2 == 0 ? box.min[axis] : box.max[axis];
    }
    const std::span<double> values(sample.data(), size);
    std::ranges::sort(values);
    std::size_t repeated = 0;
    for (std::size_t i = 1; i < size; ++i) repeated += values[i] == values[i - 1] ? 1U : 0U;
    if (repeated < size / 10) return false;
    areFloat32 = areFloat32 && std::ranges::all_of(values, [](double v) { return std::isinf(v) || isFloat32(v); });
  }
  return true;
}

}  // namespace

void FewValues::Values::start(std::size_t most) {
  m_bits = static_cast<unsigned>(std::bit_width(2 * most));
  m_slots.require(std::size_t{1} << m_bits);
  m_sorted.require(most);
  std::fill_n(m_slots.data(), std::size_t{1} << m_bits, Slot{});
  m_most = most;
  m_size = 0;
}

/// Where a value is, or where it has its place; null if that is not near.
FewValues::Values::Slot* FewValues::Values::slot(double value) const noexcept {
  // Fibonacci hashing (Knuth, "The Art of Computer Programming", volume 3, 6.4); -0 + 0 is 0.
  const std::uint64_t hash = std::bit_cast<std::uint64_t>(value + 0.0) * 0x9E3779B97F4A7C15ULL;
  const std::size_t last = (std::size_t{1} << m_bits) - 1;
  std::size_t i = hash >> (64U - m_bits);
  for (std::size_t looks = 0; looks < kMostLooks; ++looks, i = (i + 1) & last) {
    if (!m_slots[i].isTaken || m_slots[i].value == value) return &m_slots[i];
  }
  return nullptr;
}

bool FewValues::Values::add(double value) {
  Slot* const place = slot(value);
  if (place == nullptr) return false;
  if (place->isTaken) return true;
  if (m_size == m_most) return false;
  *place = {value, 0.0F, true};
  m_sorted[m_size++] = value;
  return true;
}

/// What is sorted without infinities at its ends.
std::span<double> FewValues::Values::finite() const noexcept {
  std::span<double> values(m_sorted.data(), m_size);
  if (!values.empty() && std::isinf(values.front())) values = values.subspan(1);
  if (!values.empty() && std::isinf(values.back())) values = values.first(values.size() - 1);
  return values;
}

double FewValues::Values::sort() {
  std::sort(m_sorted.data(), m_sorted.data() + m_size);
  const std::span<const double> values = finite();
  return values.empty() ? 0.0 : 0.5 * values.back() - 0.5 * values.front();
}

void FewValues::Values::assign(double span) {
  for (const double infinite : {m_sorted[0], m_sorted[m_size - 1]}) {
    if (std::isinf(infinite)) slot(infinite)->image = infinite < 0.0 ? -kLaneMax : kLaneMax;
  }
  float next = 0.0F;
  const std::span<const double> values = finite();
  for (const double value : values) {
    const double place = span > 0.0 ? (0.5 * value - 0.5 * values.front()) / span : 0.0;
    const float image = std::max(static_cast<float>(1.0 + place), next);
    slot(value)->image = image;
    next = std::nextafter(image, kLaneMax);
  }
}

void FewValues::Values::release() noexcept {
  m_slots.release();
  m_sorted.release();
}

void FewValues::release() noexcept {
  for (Values& values : m_values) values.release();
  m_rows.release();
}

bool FewValues::addAll(const BoxView& boxes, const OverlapOptions& options) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % kWorkBetweenLooks == 0) checkStop(options.stop);
    const Box box = boxes[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!m_values[axis].add(box.min[axis]) || !m_values[axis].add(box.max[axis])) return false;
    }
  }
  return true;
}

BoxView FewValues::convert(const BoxView& boxes, float* rows, Executor& executor) const {
  runInParts(boxes.size(), kPartSize, executor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Box box = boxes[i];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rows[6 * i + axis] = m_values[axis].of(box.min[axis]);
        rows[6 * i + axis + 3] = m_values[axis].of(box.max[axis]);
      }
    }
  });
  return BoxView::fromRows({rows, 6 * boxes.size()});
}

const Sets& FewValues::of(const Sets& sets, const OverlapOptions& options, Executor& executor) {
  const BoxView& first = sets.first;
  const BoxView& second = sets.second;
  const bool widens = options.distance != 0.0 || options.region || first.hasMargins() || second.hasMargins();
  const std::size_t fewest = sets.one ? first.size() : std::min(first.size(), second.size());
  if (widens || fewest < kFewestBoxes || !first.isFloat64() || !second.isFloat64()) return sets;
  bool areFloat32 = true;
  if (!seemFew(first, areFloat32) || !(sets.one || seemFew(second, areFloat32)) || areFloat32) return sets;
  const std::size_t size = first.size() + (sets.one ? 0 : second.size());
  for (Values& values : m_values) values.start(mostValuesOf(size));
  if (!addAll(first, options) || !(sets.one || addAll(second, options))) return sets;
  double span = 0.0;
  for (Values& values : m_values) span = std::max(span, values.sort());
  for (Values& values : m_values) values.assign(span);
  m_rows.require(6 * size);
  m_first = convert(first, m_rows.data(), executor);
  if (sets.one) return m_sets.emplace(m_first);
  m_second = convert(second, m_rows.data() + 6 * first.size(), executor);
  return m_sets.emplace(m_first, m_second);
}

}  // namespace allpairs::engine
