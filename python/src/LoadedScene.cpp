// SPDX-License-Identifier: MIT
#include "LoadedScene.h"

#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "Bounds.h"
#include "Executors.h"
#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "allpairs/scene/EmptyBoxes.h"
#include "allpairs/scene/ReadInput.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

using collision::CollisionModel;

scene::Scene withRootBoxes(scene::Scene scene) {
  for (const scene::SceneSearch& search : scene::searchesOf(scene)) {
    collision::CollisionPipeline pipeline;
    collision::BruteForceBroadPhase broadPhase;
    pipeline.setIntersectionMethod(search.intersection);
    pipeline.setBroadPhase(&broadPhase);
    pipeline.computeBoundingTrees(search.models, scene.timeStep);
  }
  return scene;
}

/// The six columns of a file's boxes as they lie in memory: the max corners are behind the min corners in each.
template <class T>
Table columnsOf(const BoxView::Corners<T>& corners, std::size_t size) {
  constexpr py::ssize_t kSize = sizeof(T);
  Table table = tableOf(const_cast<T*>(corners.min.data), 6 * size, 6);
  table.strides = {corners.min.boxStride * kSize, corners.min.axisStride * kSize};
  return table;
}

/// A region of boxes is one as that of models is: the broad phase says what is wrong with it.
void checkRegion(const Box& region) {
  collision::BruteForceBroadPhase broadPhase;
  broadPhase.setBox(region);
  broadPhase.init();
}

std::string nameOf(const Pair* pair) {
  return pair == nullptr ? "none" : "(" + std::to_string(pair->first) + ", " + std::to_string(pair->second) + ")";
}

/// The exhaustive search in constant memory, whose pairs have to be those that were found, in their order.
void verifyBoxes(const BoxView& boxes, std::span<const Pair> found, OverlapOptions engine) {
  engine.strategy = Strategy::Exhaustive;
  std::size_t next = 0;
  const auto compare = [&](const Pair* expected) {
    const Pair* const pair = next < found.size() ? &found[next] : nullptr;
    if (pair != nullptr && expected != nullptr && *pair == *expected) return;
    throw collision::VerificationError("verification failed: pair " + std::to_string(next) + " is " + nameOf(pair) +
                                       ", and " + nameOf(expected) + " by an exhaustive search");
  };
  const auto compareAll = [&](std::span<const Pair> batch) {
    for (const Pair& pair : batch) {
      compare(&pair);
      ++next;
    }
  };
  streamOverlaps(boxes, compareAll, engine);
  if (next != found.size()) compare(nullptr);
}

std::vector<Pair> detectBoxes(const BoxView& boxes, const DetectionOptions& options, const StopFlag& stop) {
  if (options.region) checkRegion(*options.region);
  const std::unique_ptr<Executor> executor = executorOf(options.threads);
  OverlapOptions engine;
  engine.strategy = options.strategy;
  engine.order = Order::BySecond;
  engine.distance = options.distance.value_or(0.0);
  engine.region = options.region;
  engine.executor = executor.get();
  engine.stop = &stop;
  std::vector<Pair> pairs = overlaps(boxes, engine);
  if (options.verify) verifyBoxes(boxes, pairs, engine);
  for (Pair& pair : pairs) std::swap(pair.first, pair.second);
  return pairs;
}

/// Pairs of models that are put down between two looks at a flag: a fraction of a millisecond.
constexpr std::size_t kPairsBetweenLooks = 4096;

/// Pairs by the indices of their models, which a pair may name by any level.
std::vector<Pair> indicesOf(const std::vector<collision::CollisionModelPair>& pairs, const scene::SceneSearch& search,
                            const StopFlag& stop) {
  std::vector<Pair> to;
  std::unordered_map<const CollisionModel*, std::uint32_t> indices;
  for (std::size_t i = 0; i < search.models.size(); ++i)
    indices.emplace(search.models[i]->getLast(), static_cast<std::uint32_t>(search.indices[i]));
  for (const auto& [first, second] : pairs) {
    if (to.size() % kPairsBetweenLooks == 0) checkStop(&stop);
    to.push_back({indices.at(first->getLast()), indices.at(second->getLast())});
  }
  return to;
}

/// Gives the method another alarm distance, until the end of the scope.
class AlarmDistance {
 public:
  AlarmDistance(collision::Intersection& method, std::optional<double> distance)
      : m_method(method), m_before(method.getAlarmDistance()) {
    if (distance) m_method.setAlarmDistance(*distance);
  }
  AlarmDistance(const AlarmDistance&) = delete;
  AlarmDistance& operator=(const AlarmDistance&) = delete;
  ~AlarmDistance() { m_method.setAlarmDistance(m_before); }

 private:
  collision::Intersection& m_method;
  double m_before;
};

std::vector<Pair> pairsOf(const scene::SceneSearch& search, double timeStep, const DetectionOptions& options,
                          const StopFlag& stop) {
  const AlarmDistance distance(*search.intersection, options.distance);
  const std::unique_ptr<Executor> executor = executorOf(options.threads);
  collision::BruteForceBroadPhase broadPhase;
  const std::optional<Box> region = options.region ? options.region : search.region;
  if (region) broadPhase.setBox(*region);
  broadPhase.setStrategy(options.strategy);
  broadPhase.setExecutor(executor.get());
  broadPhase.setStop(&stop);
  collision::CollisionPipeline pipeline;
  pipeline.setIntersectionMethod(search.intersection);
  pipeline.setBroadPhase(&broadPhase);
  const auto& pairs = pipeline.step(search.models, timeStep);
  if (options.verify) broadPhase.verify();
  return indicesOf(pairs, search, stop);
}

}  // namespace

LoadedScene::LoadedScene(const std::filesystem::path& path, const scene::ReadOptions& options) {
  std::error_code ignored;
  if (scene::isBoxArrayFile(path) && !std::filesystem::is_directory(path, ignored)) {
    m_boxArray.emplace(scene::readBoxArray(path, options));
    m_scene.warnings = scene::boxWarnings(*m_boxArray, path);
  } else {
    m_scene = withRootBoxes(scene::readInput(path, options));
    for (const auto& model : m_scene.models) append(m_rootBoxes, scene::modelRecord(*model).box);
  }
  m_boxes = boxes();
  m_boxes.isReadOnly = true;
}

std::size_t LoadedScene::size() const { return m_boxArray ? m_boxArray->size() : m_scene.models.size(); }

scene::ModelRecord LoadedScene::model(std::size_t index) const {
  if (index >= size()) throw py::index_error();
  if (m_boxArray) {
    return {.name = m_boxArray->name(index), .type = "BoxModel", .elements = 1, .box = m_boxArray->boxes()[index]};
  }
  return scene::modelRecord(*m_scene.models[index]);
}

Table LoadedScene::boxes() {
  if (!m_boxArray) return tableOf(m_rootBoxes.data(), m_rootBoxes.size(), 6);
  const BoxView& set = m_boxArray->boxes();
  return set.isFloat64() ? columnsOf(set.float64(), set.size()) : columnsOf(set.float32(), set.size());
}

std::vector<Pair> LoadedScene::detect(const DetectionOptions& options, Stopper& stopper) {
  const std::lock_guard lock(m_mutex);
  const Stopper::Hold hold(stopper, m_stop);
  const StopFlag& stop = m_stop.flag();
  if (m_boxArray) return detectBoxes(m_boxArray->boxes(), options, stop);
  std::vector<Pair> pairs;
  for (const scene::SceneSearch& search : scene::searchesOf(m_scene)) {
    const std::vector<Pair> more = pairsOf(search, m_scene.timeStep, options, stop);
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  return pairs;
}

}  // namespace allpairs::python
