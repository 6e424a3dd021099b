// SPDX-License-Identifier: MIT
#include "MovingSearch.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"

namespace allpairs::bench {

namespace {

/// Everything that a step gives: the pairs, and which began, persist and ended.
class WorldSteps final : public MovingSearch {
 public:
  void start(const MovingScene& scene) override { m_ids = m_world.add(BoxView::fromRows(scene.rows())); }

  void step(const MovingScene& scene) override {
    m_world.move(scene.movingIds(), BoxView::fromRows(scene.movingRows()));
    m_result = m_world.step();
  }

  void collect(const MovingScene& /*scene*/, std::vector<Pair>& pairs) override {
    pairs.assign(m_result.pairs.begin(), m_result.pairs.end());
  }

 private:
  World m_world;
  std::vector<BoxId> m_ids;
  StepResult m_result;
};

/// A full search in each frame, in reused memory.
class OneShot final : public MovingSearch {
 public:
  explicit OneShot(Order order) {
    OverlapOptions options;
    options.order = order;
    m_search.setOptions(options);
  }

  void start(const MovingScene& /*scene*/) override {}
  void step(const MovingScene& scene) override { m_pairs = m_search.find(BoxView::fromRows(scene.rows())); }
  void collect(const MovingScene& /*scene*/, std::vector<Pair>& pairs) override {
    pairs.assign(m_pairs.begin(), m_pairs.end());
  }

 private:
  OverlapSearch m_search;
  std::span<const Pair> m_pairs;
};

}  // namespace

std::vector<MovingContender> ownContenders() {
  return {
      {"Allpairs", "world", [] { return std::make_unique<WorldSteps>(); }, true},
      {"Allpairs", "one-shot, ordered", [] { return std::make_unique<OneShot>(Order::ByFirst); }, true},
      {"Allpairs", "one-shot, unordered", [] { return std::make_unique<OneShot>(Order::Unordered); }, true},
  };
}

}  // namespace allpairs::bench
