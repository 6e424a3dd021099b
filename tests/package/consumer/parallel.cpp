// SPDX-License-Identifier: MIT
#include <allpairs/Overlaps.h>
#include <allpairs/parallel/TbbExecutor.h>

#include <cstdlib>
#include <vector>

int main() {
  allpairs::parallel::TbbExecutor threads(2);
  const std::vector<allpairs::Box> boxes(100, allpairs::Box{{0, 0, 0}, {1, 1, 1}});
  allpairs::OverlapOptions options;
  options.executor = &threads;
  return allpairs::countOverlaps(boxes, options) == 4950 ? EXIT_SUCCESS : EXIT_FAILURE;
}
