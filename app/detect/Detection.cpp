// SPDX-License-Identifier: MIT
#include "detect/Detection.h"

#include <chrono>

#include "allpairs/parallel/TbbExecutor.h"

namespace allpairs::app {
namespace {

/// Below this a search takes less than waking a pool of threads does.
constexpr std::size_t kWorthThreads = 20'000;

}  // namespace

Strategy strategyOf(const std::string& name) {
  if (name == "exhaustive") return Strategy::Exhaustive;
  return name == "bvh" ? Strategy::Bvh : Strategy::Automatic;
}

std::string strategyName(Strategy strategy) {
  if (strategy == Strategy::Exhaustive) return "exhaustive";
  return strategy == Strategy::Bvh ? "bvh" : "auto";
}

OverlapOptions overlapOptions(const DetectionOptions& options, Executor* executor) {
  OverlapOptions engine;
  engine.strategy = options.strategy;
  engine.distance = options.distance.value_or(0.0);
  engine.region = options.region;
  engine.filter.first.groups = options.groups;
  engine.executor = executor;
  return engine;
}

std::unique_ptr<Executor> makeExecutor(std::size_t threads, std::size_t models) {
  if (threads == 1 || models < kWorthThreads) return nullptr;
  return std::make_unique<parallel::TbbExecutor>(threads);
}

}  // namespace allpairs::app
