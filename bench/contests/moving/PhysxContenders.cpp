// SPDX-License-Identifier: MIT
// PhysX's automatic box pruning on its own, updated in each frame. It tells which pairs began and which ended, and
// keeps the list of all to itself; ours gives that list too.
#include <algorithm>
#include <set>

#include "MovingSearch.h"
#include "PhysxBoxes.h"

namespace allpairs::bench {

namespace {

using Results = physx::PxBroadPhaseResults;

class PhysxSteps final : public MovingSearch {
 public:
  void start(const MovingScene& scene) override {
    m_boxes.append(scene.rows(), true);
    take([&](Results& results) { m_broadPhase->updateAndFetchResults(results, m_boxes.creation()); });
  }

  void step(const MovingScene& scene) override {
    for (const BoxId id : scene.movingIds()) m_boxes.set(id, scene.rows().data() + std::size_t{6} * id);
    take([&](Results& results) { m_broadPhase->updateAndFetchResults(results, m_boxes.update(scene.movingIds())); });
  }

  void collect(const MovingScene& /*scene*/, std::vector<Pair>& pairs) override {
    for (const Change& change : m_changes) {
      if (change.began) {
        m_pairs.insert(change.pair);
      } else {
        m_pairs.erase(change.pair);
      }
    }
    m_changes.clear();
    pairs.assign(m_pairs.begin(), m_pairs.end());
  }

 private:
  struct Change {
    Pair pair;
    bool began;
  };

  /// Writes down what has changed, which is little beside the update; the list is made of it outside the time.
  template <class Update>
  void take(Update update) {
    Results results;
    update(results);
    const auto add = [&](const physx::PxBroadPhasePair* pairs, std::size_t count, bool began) {
      for (const auto& pair : std::span(pairs, count)) {
        m_changes.push_back({{std::min(pair.mID0, pair.mID1), std::max(pair.mID0, pair.mID1)}, began});
      }
    };
    add(results.mDeletedPairs, results.mNbDeletedPairs, false);
    add(results.mCreatedPairs, results.mNbCreatedPairs, true);
  }

  PhysxBroadPhase m_broadPhase = makePhysxBroadPhase();
  PhysxBoxes m_boxes;
  std::vector<Change> m_changes;
  std::set<Pair> m_pairs;
};

}  // namespace

void addPhysxContenders(std::vector<MovingContender>& contenders) {
  contenders.push_back({"PhysX", "ABP", [] { return std::make_unique<PhysxSteps>(); }});
}

}  // namespace allpairs::bench
