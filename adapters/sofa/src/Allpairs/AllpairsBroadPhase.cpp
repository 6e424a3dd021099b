// SPDX-License-Identifier: MIT
#include <Allpairs/AllpairsBroadPhase.h>
#include <Allpairs/MethodBridge.h>
#include <Allpairs/ModelPool.h>
#include <sofa/component/collision/detection/algorithm/BruteForceBroadPhase.h>
#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/core/ObjectFactory.h>
#include <sofa/core/collision/Intersection.h>

#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "allpairs/collision/BruteForceBroadPhase.h"

#ifdef ALLPAIRS_SOFA_HAS_PARALLEL
#include "allpairs/parallel/TbbExecutor.h"
#endif

namespace allpairs::plugin {
namespace {

using sofa::component::collision::geometry::CubeCollisionModel;
using Stock = sofa::component::collision::detection::algorithm::BruteForceBroadPhase;
using PairList = sofa::type::vector<sofa::core::collision::BroadPhaseDetection::CollisionModelPair>;

constexpr int kMostThreads = 9999;  // that TbbExecutor takes

/// In the order of the options of `strategy`.
constexpr Strategy kStrategies[] = {Strategy::Automatic, Strategy::Exhaustive, Strategy::Bvh};

std::string nameOf(const PairList& pairs, std::size_t i) {
  if (i >= pairs.size()) return "no pair";
  std::string name = "(";  // appended to: GCC 12 warns of operator+ where its first operand is a literal
  name += pairs[i].first->getLast()->getPathName() + ", " + pairs[i].second->getLast()->getPathName() + ")";
  return name;
}

}  // namespace

struct AllpairsBroadPhase::State {
  ModelPool models;
  MethodBridge methods;
  collision::BruteForceBroadPhase phase;
  std::vector<sofa::core::CollisionModel*> taking;  // of the models that are being added, those that take part
  std::size_t collected = 0;                        // how many of the phase's pairs are in the component's list
  CubeCollisionModel::SPtr region;
  unsigned strategy = 0;
  int threads = 1;
  std::unique_ptr<Executor> executor;
  // SOFA's own, for `verify`; always there, since its box is the one that was there when the settings were read.
  Stock::SPtr stock = sofa::core::objectmodel::New<Stock>();
  bool verifies = false;
  bool differed = false;
};

AllpairsBroadPhase::AllpairsBroadPhase()
    : d_box(initData(&d_box, "box", "if not empty, objects that do not intersect this bounding-box will be ignored")),
      d_strategy(initData(&d_strategy, sofa::helper::OptionsGroup{"automatic", "exhaustive", "bvh"}, "strategy",
                          "how pairs are found; every strategy gives the same list")),
      d_threads(initData(&d_threads, 1, "threads", "how many threads search; 0 means all that the machine has")),
      d_verify(initData(&d_verify, false, "verify",
                        "run BruteForceBroadPhase beside it and report every step whose list differs as an error")),
      m_state(std::make_unique<State>()) {}

AllpairsBroadPhase::~AllpairsBroadPhase() = default;

void AllpairsBroadPhase::init() { reinit(); }

void AllpairsBroadPhase::reinit() {
  readRegion();
  m_state->stock->findData("box")->copyValueFrom(&d_box);
  m_state->stock->reinit();
}

/// SOFA takes any word as a choice: one that is no name as the number that it begins with, which is 0 where it begins
/// with none.
bool AllpairsBroadPhase::parseField(const std::string& attribute, const std::string& value) {
  const bool isRead = Inherit1::parseField(attribute, value);
  if (attribute != "strategy" || value.starts_with('@')) return isRead;
  auto strategy = d_strategy.getValue();
  if (value == strategy.getSelectedItem() || value == std::to_string(strategy.getSelectedId())) return isRead;
  msg_error() << "'strategy' is '" << value << "', not automatic, exhaustive or bvh; automatic is used";
  d_strategy.setValue(strategy.setSelectedItem("automatic"));
  return false;
}

void AllpairsBroadPhase::readRegion() {
  const Region& box = d_box.getValue();
  m_state->region.reset();
  if (!(box[0][0] >= box[1][0])) {  // as SOFA compares them: a NaN is a region
    m_state->region = sofa::core::objectmodel::New<CubeCollisionModel>();
    m_state->region->resize(1);
    m_state->region->setParentOf(0, box[0], box[1]);
  }
  const bool isRegion = box[0][0] < box[1][0] && box[0][1] < box[1][1] && box[0][2] < box[1][2];
  if (!d_box.isSet() || isRegion) return;
  msg_warning() << "'box' does not have min < max on every axis: " << box
                << (m_state->region ? "; as in BruteForceBroadPhase it is in force"
                                    : "; as in BruteForceBroadPhase it "
                                      "is not in force");
}

void AllpairsBroadPhase::readStrategy() {
  const unsigned choice = d_strategy.getValue().getSelectedId();
  const bool isOurs = choice < std::size(kStrategies);  // a link may bring choices of another component
  if (!isOurs) msg_error() << "there is no choice " << choice << " of 'strategy'; automatic is used";
  m_state->phase.setStrategy(isOurs ? kStrategies[choice] : Strategy::Automatic);
  m_state->strategy = choice;
}

void AllpairsBroadPhase::readThreads() {
  const int threads = d_threads.getValue();
  m_state->phase.setExecutor(nullptr);  // before it goes
  m_state->executor.reset();
  if (threads < 0 || threads > kMostThreads) {
    msg_error() << "'threads' is " << threads << ", not 0 to " << kMostThreads << "; one thread is used";
  } else if (threads != 1) {
#ifdef ALLPAIRS_SOFA_HAS_PARALLEL
    m_state->executor = std::make_unique<parallel::TbbExecutor>(static_cast<std::size_t>(threads));
#else
    msg_warning() << "'threads' is " << threads << ", but the plugin was built without oneTBB; one thread is used";
#endif
  }
  m_state->phase.setExecutor(m_state->executor.get());
  m_state->threads = threads;  // else the next step tries again
}

void AllpairsBroadPhase::beginBroadPhase() {
  Inherit1::beginBroadPhase();
  State& state = *m_state;
  if (d_threads.getValue() != state.threads) readThreads();
  if (d_strategy.getValue().getSelectedId() != state.strategy) readStrategy();
  state.verifies = d_verify.getValue();
  state.phase.beginBroadPhase();
  state.models.begin();
  state.collected = 0;
  state.differed = false;
  if (state.verifies) state.stock->beginBroadPhase();
}

void AllpairsBroadPhase::endBroadPhase() {
  Inherit1::endBroadPhase();
  m_state->models.end();
}

void AllpairsBroadPhase::cleanup() {
  m_state->models.begin();
  m_state->models.end();
  Inherit1::cleanup();
}

void AllpairsBroadPhase::addCollisionModel(sofa::core::CollisionModel* cm) { addAll(&cm, 1); }

void AllpairsBroadPhase::addCollisionModels(const sofa::type::vector<sofa::core::CollisionModel*>& models) {
  addAll(models.data(), models.size());
}

void AllpairsBroadPhase::addAll(sofa::core::CollisionModel* const* models, std::size_t count) {
  State& state = *m_state;
  if (intersectionMethod == nullptr) {
    msg_error() << "there is no intersection method: no pairs are found";
    return;
  }
  state.taking.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const bool takesPart = models[i] != nullptr && !models[i]->empty() && isInRegion(*models[i]);
    if (takesPart) state.taking.push_back(models[i]);
  }
  const auto added = state.models.add(state.taking);
  state.phase.setIntersectionMethod(&state.methods.choose(*intersectionMethod, state.models));
  for (collision::HostedModel* model : added) state.phase.addCollisionModel(model);
  collectPairs();
  if (!state.verifies) return;
  state.stock->setIntersectionMethod(intersectionMethod);
  for (std::size_t i = 0; i < count; ++i) state.stock->addCollisionModel(models[i]);
  comparePairs();
}

bool AllpairsBroadPhase::isInRegion(sofa::core::CollisionModel& model) const {
  if (!m_state->region) return true;
  sofa::core::CollisionModel* first = &model;
  sofa::core::CollisionModel* second = m_state->region.get();
  bool swap = false;
  auto* intersector = intersectionMethod->findIntersector(first, second, swap);
  if (intersector == nullptr) return true;
  if (swap) std::swap(first, second);
  return intersector->canIntersect(first->begin(), second->begin(), intersectionMethod);
}

void AllpairsBroadPhase::collectPairs() {
  const auto& pairs = m_state->phase.getCollisionModelPairs();
  for (; m_state->collected < pairs.size(); ++m_state->collected) {
    const auto& [first, second] = pairs[m_state->collected];
    cmPairs.emplace_back(hostOf(*first), hostOf(*second));
  }
}

void AllpairsBroadPhase::comparePairs() {
  const PairList& expected = m_state->stock->getCollisionModelPairs();
  if (m_state->differed || cmPairs == expected) return;
  std::size_t i = 0;
  while (i < cmPairs.size() && i < expected.size() && cmPairs[i] == expected[i]) ++i;
  m_state->differed = true;
  msg_error() << "pair " << i << " is " << nameOf(cmPairs, i) << ", but BruteForceBroadPhase gives "
              << nameOf(expected, i);
}

/// Enters the component in SOFA's factory.
void registerAllpairsBroadPhase(sofa::core::ObjectFactory* factory) {
  factory->registerObjects(
      sofa::core::ObjectRegistrationData("Broad phase by Allpairs: the pairs of BruteForceBroadPhase, found faster.")
          .add<AllpairsBroadPhase>());
}

}  // namespace allpairs::plugin
