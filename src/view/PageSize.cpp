// SPDX-License-Identifier: MIT
#include "PageSize.h"

#include <fmt/format.h>

#include <algorithm>

#include "allpairs/Error.h"

namespace allpairs::view {
namespace {

constexpr std::size_t kMostBytes = std::size_t{256} << 20U;  // as base64, about what browsers take for one text

}  // namespace

bool areFloats(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double number) { return static_cast<double>(static_cast<float>(number)) == number; });
}

std::size_t bytesOf(const ViewFrame& frame, std::size_t pairs) {
  const std::size_t position = areFloats(frame.positions) ? sizeof(float) : sizeof(double);
  const std::size_t shape =
      frame.positions.empty() ? frame.boxes.size() * sizeof(Box) : frame.positions.size() * position;
  return shape + frame.flags.size() + pairs * sizeof(Pair);
}

void checkPageSize(const ViewScene& scene, std::size_t frames, std::size_t bytes) {
  if (bytes <= kMostBytes) return;
  const bool isSequence = frames > 1 || !scene.corners.empty();
  throw Error(fmt::format(
      "{}: {} models and their pairs are too much for one page, which holds {} MiB: {}", scene.title, scene.modelCount,
      kMostBytes >> 20U,
      isSequence ? "give fewer frames, or a smaller distance" : "give a smaller distance, or fewer inputs"));
}

}  // namespace allpairs::view
