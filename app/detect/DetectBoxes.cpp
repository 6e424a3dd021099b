// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <utility>

#include "allpairs/collision/BruteForceBroadPhase.h"
#include "cli/Timer.h"
#include "detect/Detection.h"

namespace allpairs::app {
namespace {

[[noreturn]] void reportDifference(const scene::BoxArray& boxes, const Pair& pair, bool isMissing) {
  throw collision::VerificationError(
      "verification failed: '" + boxes.name(pair.first) + "' and '" + boxes.name(pair.second) +
      (isMissing ? "' are a pair that was not found" : "' were found and are not a pair"));
}

/// Runs the exhaustive search in constant memory and compares it with what was found, pair by pair, in order.
void verifyBoxes(const scene::BoxArray& boxes, const Detection& found, OverlapOptions options) {
  const Order order = options.order;
  options.strategy = Strategy::Exhaustive;
  std::size_t next = 0;
  const auto comesBefore = [order](const Pair& a, const Pair& b) {
    return order == Order::ByFirst ? a < b : std::pair(a.second, a.first) < std::pair(b.second, b.first);
  };
  const auto compare = [&](std::span<const Pair> batch) {
    for (const Pair& pair : batch) {
      if (next < found.pairs.size() && found.pairs[next] == pair) {
        ++next;
      } else {
        const bool isMissing = next == found.pairs.size() || comesBefore(pair, found.pairs[next]);
        reportDifference(boxes, isMissing ? pair : found.pairs[next], isMissing);
      }
    }
  };
  streamOverlaps(boxes.boxes(), compare, options);
  if (next != found.pairs.size()) reportDifference(boxes, found.pairs[next], false);
}

std::uint64_t testsOfAllPairs(std::uint64_t count) {
  return count == 0 ? 0 : count * (count - 1) / 2;  // fits: indices have 32 bits
}

}  // namespace

Detection detectBoxes(const scene::BoxArray& boxes, BoxPairOrder order, const DetectionOptions& options) {
  const std::unique_ptr<Executor> executor = makeExecutor(options.threads, boxes.size());
  OverlapOptions engine = overlapOptions(options, executor.get());
  engine.order = order == BoxPairOrder::NewestFirst ? Order::BySecond : Order::ByFirst;
  Detection detection;
  detection.search = std::make_unique<OverlapSearch>(engine);
  const Timer timer;
  detection.pairs = detection.search->find(boxes.boxes());
  const OverlapStatistics& counted = detection.search->statistics();
  detection.swapped = order == BoxPairOrder::NewestFirst;
  detection.statistics = {.strategy = strategyName(options.strategy),
                          .threads = executor ? executor->concurrency() : 1,
                          .distance = engine.distance,
                          .testsOfAllPairs = testsOfAllPairs(boxes.size()),
                          .testsMade = counted.boxTests + counted.groupTests,
                          .detectSeconds = timer.seconds()};
  if (options.verify) verifyBoxes(boxes, detection, engine);
  detection.statistics.verified = options.verify;
  return detection;
}

}  // namespace allpairs::app
