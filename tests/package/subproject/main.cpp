// SPDX-License-Identifier: MIT
#include <allpairs/Error.h>
#include <allpairs/Overlaps.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace {

/// Whether a NaN among so many boxes is found; the bits are written, since -ffast-math says that there is none.
bool isNanFound(std::size_t count) {
  std::vector<float> rows(6 * count, 1.0F);
  const std::uint32_t nan = 0x7FC00000;
  std::memcpy(&rows[6 * (count / 2)], &nan, sizeof(nan));
  try {
    (void)allpairs::countOverlaps(allpairs::BoxView::fromRows(rows));
  } catch (const allpairs::InvalidBox& problem) {
    return problem.index() == count / 2;
  }
  return false;
}

}  // namespace

int main() {
  const std::vector<allpairs::Box> boxes{{{0, 0, 0}, {2, 2, 2}}, {{2, 2, 2}, {3, 3, 3}}, {{5, 5, 5}, {6, 6, 6}}};
  const std::vector<allpairs::Pair> pairs = allpairs::overlaps(boxes);
  const bool isRight = pairs.size() == 1 && pairs[0] == allpairs::Pair{0, 1};
  return isRight && isNanFound(2) && isNanFound(40) ? 0 : 1;
}
