// SPDX-License-Identifier: MIT
// Searches that another thread stops while they run.
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"

namespace allpairs {
namespace {

/// Boxes without any pair, or all at one place; a search for their pairs takes seconds.
std::vector<BoxF> manyBoxes(std::size_t n, float step) {
  std::vector<BoxF> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    const float at = step * static_cast<float>(i);
    boxes.push_back({{at, 0, 0}, {at + 1, 1, 1}});
  }
  return boxes;
}

/// A search that does not look at its flag would end without an exception, seconds later.
void stopInTheMiddle(const std::vector<BoxF>& boxes, OverlapOptions options) {
  StopFlag stop;
  options.stop = &stop;
  std::jthread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.set();
  });
  EXPECT_THROW(static_cast<void>(countOverlaps(boxes, options)), Stopped);
}

TEST(StopOnAThread, EndsOneLongTaskOfTheSearch) {
  OverlapOptions options;
  options.strategy = Strategy::Exhaustive;
  stopInTheMiddle(manyBoxes(500'000, 2), options);
  options.strategy = Strategy::Bvh;
  stopInTheMiddle(manyBoxes(500'000, 0), options);
  parallel::TbbExecutor two(2);
  options.executor = &two;
  stopInTheMiddle(manyBoxes(500'000, 0), options);
}

}  // namespace
}  // namespace allpairs
