// SPDX-License-Identifier: MIT
// PhysX's broad phase on its own, by automatic box pruning, all boxes added at once. Its sweep and prune is left out:
// it rounds bounds to fewer bits, and so reports pairs that do not overlap.
#include "PhysxBoxes.h"
#include "SetPeer.h"

namespace allpairs::bench {

namespace {

class PhysxOfSets final : public SetSearch<float> {
 public:
  std::span<const Pair> find(const Sets<float>& sets) override {
    clear();
    m_boxes.append(sets.first, !sets.areTwo);
    const auto inFirst = static_cast<std::uint32_t>(sets.first.size() / 6);
    if (sets.areTwo) m_boxes.append(sets.second, false);
    m_broadPhase = makePhysxBroadPhase();
    physx::PxBroadPhaseResults results;
    m_broadPhase->updateAndFetchResults(results, m_boxes.creation());
    m_pairs.reserve(results.mNbCreatedPairs);
    for (const auto& pair : std::span(results.mCreatedPairs, results.mNbCreatedPairs)) {
      if (!sets.areTwo) {
        m_pairs.push_back({pair.mID0, pair.mID1});
      } else {
        m_pairs.push_back({std::min(pair.mID0, pair.mID1), std::max(pair.mID0, pair.mID1) - inFirst});
      }
    }
    return m_pairs;
  }

  void clear() override {
    m_broadPhase.reset();
    m_boxes = {};
    m_pairs = {};
  }

 private:
  PhysxBoxes m_boxes;
  PhysxBroadPhase m_broadPhase;
  std::vector<Pair> m_pairs;
};

}  // namespace

SetPeer<float> physxOfSets() {
  return {"PhysX", {{"ABP", [] { return std::make_unique<PhysxOfSets>(); }}}};
}

}  // namespace allpairs::bench
