// SPDX-License-Identifier: MIT
#include "allpairs/collision/BruteForceBroadPhase.h"

#include <array>
#include <charconv>
#include <string>
#include <utility>

#include "ModelTable.h"
#include "PairRules.h"
#include "PairSearch.h"
#include "allpairs/collision/BoxModel.h"

namespace allpairs::collision {
namespace {

/// The shortest text that reads as the same number.
std::string textOf(double number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

void checkRegion(const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.min[axis] < box.max[axis])) {
      throw InvalidArgument("the region box does not have min < max on the " + std::string(1, "xyz"[axis]) +
                            " axis: " + textOf(box.min[axis]) + " to " + textOf(box.max[axis]));
    }
  }
}

std::string nameOf(const std::vector<CollisionModelPair>& pairs, std::size_t i) {
  if (i >= pairs.size()) return "no pair";
  return "(" + pairs[i].first->describe() + ", " + pairs[i].second->describe() + ")";
}

}  // namespace

struct BruteForceBroadPhase::State {
  /// Sees to it that rules are those of the method as it is now; rows that came before keep the ones they came with.
  void useMethod(Intersection* method);

  /// Throws InvalidArgument if there is no method, or not the one of the whole step.
  void checkMethod(const Intersection* method) const;

  /// Gives the pairs of all rows that were added and not looked at yet.
  void complete();

  std::optional<Box> box;
  std::unique_ptr<BoxModel> region;
  ModelTable models;
  PairRules rules{models};
  PairSearch search{models, rules};
  bool hasOneMethod = true;  ///< All rows of the step came with the same one.
  std::size_t rowsDone = 0;
  std::vector<CollisionModelPair> pairs;
  BroadPhaseStatistics statistics;
};

void BruteForceBroadPhase::State::useMethod(Intersection* method) {
  if (method == nullptr) throw InvalidArgument("the broad phase has no intersection method");
  if (!rules.isOutdated(method)) return;
  complete();
  hasOneMethod = hasOneMethod && models.size() == 0;
  rules.setMethod(method);
}

void BruteForceBroadPhase::State::checkMethod(const Intersection* method) const {
  if (method == nullptr) throw InvalidArgument("the broad phase has no intersection method");
  if (models.size() == 0 || (hasOneMethod && !rules.isOutdated(method))) return;
  throw InvalidArgument("the intersection method is not as it was in the whole step: nothing to verify the step by");
}

void BruteForceBroadPhase::State::complete() {
  const std::size_t n = models.size();
  if (rowsDone != n) {
    const std::size_t pairsBefore = pairs.size();
    const BroadPhaseStatistics statisticsBefore = statistics;
    try {
      search.addPairs(rowsDone, pairs, statistics);
    } catch (...) {
      // What a rule threw on leaves the list as it was, so that the next attempt reports no pair twice.
      pairs.resize(pairsBefore);
      statistics = statisticsBefore;
      throw;
    }
    rowsDone = n;
  }
  statistics.models = n;
  statistics.pairs = pairs.size();
  statistics.testsOfAllPairs = n == 0 ? 0 : std::uint64_t{n} * (n - 1) / 2;
}

BruteForceBroadPhase::BruteForceBroadPhase() : m_state(std::make_unique<State>()) {}
BruteForceBroadPhase::~BruteForceBroadPhase() = default;

void BruteForceBroadPhase::init() { reinit(); }

void BruteForceBroadPhase::reinit() {
  std::unique_ptr<BoxModel> region;
  if (m_state->box) {
    checkRegion(*m_state->box);
    region = std::make_unique<BoxModel>("region", *m_state->box);
    region->computeBoundingTree(0);
  }
  m_state->region = std::move(region);
}

void BruteForceBroadPhase::beginBroadPhase() {
  m_state->models.clear();
  m_state->rules.forget();
  m_state->hasOneMethod = true;
  m_state->pairs.clear();
  m_state->rowsDone = 0;
  m_state->statistics = {};
}

void BruteForceBroadPhase::addCollisionModel(core::CollisionModel* cm) {
  if (add(*m_state, cm) != PairRule::None) return;
  if (m_state->search.strategy() == Strategy::Exhaustive) m_state->complete();
}

PairRule BruteForceBroadPhase::add(State& step, core::CollisionModel* cm) {
  if (cm == nullptr) return PairRule::NoElements;
  CollisionModel& last = *cm->getLast();
  const bool ours = step.models.isOurs(last);
  if (ModelTable::isEmpty(last, ours)) return PairRule::NoElements;
  step.useMethod(getIntersectionMethod());
  if (!last.hasBoundingTree()) {
    last.computeBoundingTree(0);
    if (cm != &last) cm = last.getFirst();  // what was given may be gone with the old tree
  }
  if (m_state->region && !intersectWithBoxModel(cm)) return PairRule::OutsideRegion;
  const bool mayHaveSelfPair = !ours || last.getSelfCollision();
  step.models.add(cm, ours, mayHaveSelfPair && doesSelfCollide(cm));
  return PairRule::None;
}

void BruteForceBroadPhase::addCollisionModels(Span<core::CollisionModel* const> models) {
  BroadPhaseDetection::addCollisionModels(models);
  m_state->complete();
}

void BruteForceBroadPhase::endBroadPhase() { m_state->complete(); }

const std::vector<CollisionModelPair>& BruteForceBroadPhase::getCollisionModelPairs() {
  m_state->complete();
  return m_state->pairs;
}

bool BruteForceBroadPhase::keepCollisionBetween(core::CollisionModel* cm1, core::CollisionModel* cm2) {
  if (cm1 == nullptr || cm2 == nullptr) return false;
  CollisionModel* last1 = cm1->getLast();
  CollisionModel* last2 = cm2->getLast();
  return last1->canCollideWith(last2) && last2->canCollideWith(last1);
}

bool BruteForceBroadPhase::doesSelfCollide(core::CollisionModel* cm) { return selfRule(cm) == PairRule::None; }

PairRule BruteForceBroadPhase::selfRule(core::CollisionModel* cm) const {
  CollisionModel* last = cm->getLast();
  if (!cm->isSimulated()) return PairRule::NotSimulated;
  if (!last->canCollideWith(last)) return PairRule::OneOwner;
  return PairRules::ruleOfRoots(cm, cm, *getIntersectionMethod());
}

PairVerdict BruteForceBroadPhase::judge(core::CollisionModel* newer, core::CollisionModel* older) {
  State step;
  // The levels above the elements may be gone once a tree is computed.
  if (newer != nullptr) newer = newer->getLast();
  if (older != nullptr) older = older->getLast();
  for (core::CollisionModel* model : {older, newer}) {
    if (const PairRule rule = add(step, model); rule != PairRule::None) return {rule, model};
  }
  if (older != newer) return {step.rules.judge(1, 0).rule, nullptr};
  const PairRule rule = selfRule(newer);
  const bool isOurs = step.models.row(0).has(ModelRow::kDefaultRules);
  return {rule == PairRule::OneOwner && !isOurs ? PairRule::Refused : rule, nullptr};
}

bool BruteForceBroadPhase::intersectWithBoxModel(core::CollisionModel* cm) {
  if (!m_state->region) return true;
  return PairRules::ruleOfRoots(cm, m_state->region.get(), *getIntersectionMethod()) != PairRule::Apart;
}

void BruteForceBroadPhase::setBox(const Vec3& min, const Vec3& max) { m_state->box = Box{min, max}; }
void BruteForceBroadPhase::setBox(const Box& box) { m_state->box = box; }
void BruteForceBroadPhase::clearBox() { m_state->box.reset(); }
const std::optional<Box>& BruteForceBroadPhase::getBox() const { return m_state->box; }

void BruteForceBroadPhase::setStrategy(Strategy strategy) { m_state->search.setStrategy(strategy); }
Strategy BruteForceBroadPhase::getStrategy() const { return m_state->search.strategy(); }
void BruteForceBroadPhase::setKeepsSearch(bool keeps) { m_state->search.setKept(keeps); }
bool BruteForceBroadPhase::getKeepsSearch() const { return m_state->search.isKept(); }
void BruteForceBroadPhase::setExecutor(Executor* executor) { m_state->search.setExecutor(executor); }
void BruteForceBroadPhase::setStop(const StopFlag* stop) { m_state->search.setStop(stop); }
const BroadPhaseStatistics& BruteForceBroadPhase::statistics() const { return m_state->statistics; }

void BruteForceBroadPhase::verify() {
  m_state->complete();
  m_state->checkMethod(getIntersectionMethod());
  std::vector<CollisionModelPair> expected;
  for (std::size_t newer = 0; newer < m_state->models.size(); ++newer) {
    checkStop(m_state->search.stop());
    CollisionModel* model = m_state->models.row(newer).model;
    if (doesSelfCollide(model)) expected.emplace_back(model, model);
    for (std::size_t older = 0; older < newer; ++older) {
      if (const auto pair = m_state->rules.judge(newer, older).pair) expected.push_back(*pair);
    }
  }
  const std::vector<CollisionModelPair>& found = m_state->pairs;
  if (found == expected) return;
  std::size_t i = 0;
  while (i < found.size() && i < expected.size() && found[i] == expected[i]) ++i;
  throw VerificationError("pair " + std::to_string(i) + " is " + nameOf(found, i) + ", but the double loop gives " +
                          nameOf(expected, i));
}

}  // namespace allpairs::collision
