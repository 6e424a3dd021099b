// SPDX-License-Identifier: MIT
// Makes scenes of SOFA in memory whose collision models change from step to step: they come and go, move to another
// node, change groups, flags, distances and depth of their bounding trees. Compares the list of a broad phase with that
// of SOFA's BruteForceBroadPhase in every step.
#include <sofa/component/collision/detection/algorithm/BruteForceBroadPhase.h>
#include <sofa/component/collision/detection/intersection/DiscreteIntersection.h>
#include <sofa/component/collision/detection/intersection/NewProximityIntersection.h>
#include <sofa/component/collision/geometry/PointCollisionModel.h>
#include <sofa/component/collision/geometry/SphereCollisionModel.h>
#include <sofa/component/statecontainer/MechanicalObject.h>
#include <sofa/core/ObjectFactory.h>
#include <sofa/simulation/Simulation.h>

#include <cstdio>
#include <exception>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "SceneRun.h"

namespace {

using allpairs::tools::BroadPhase;
using sofa::core::CollisionModel;
using sofa::core::objectmodel::New;
using sofa::defaulttype::Vec3Types;
using sofa::type::Vec3;
namespace geometry = sofa::component::collision::geometry;
namespace detection = sofa::component::collision::detection;
using State = sofa::component::statecontainer::MechanicalObject<Vec3Types>;

/// A scene of spheres and points, three points a body, all at quarters, so that boxes often just touch.
class ChangingScene {
 public:
  explicit ChangingScene(unsigned seed)
      : m_random(seed), m_root(sofa::simulation::getSimulation()->createNewGraph("root")) {
    for (int i = 0; i < 30; ++i) addBody();
  }
  ChangingScene(const ChangingScene&) = delete;
  ChangingScene& operator=(const ChangingScene&) = delete;
  ChangingScene(ChangingScene&&) = delete;
  ChangingScene& operator=(ChangingScene&&) = delete;
  ~ChangingScene() { sofa::simulation::node::unload(m_root); }

  sofa::simulation::Node& root() { return *m_root; }

  void change() {
    for (int i = upTo(4); i > 0; --i) (this->*kWays[static_cast<std::size_t>(upTo(std::size(kWays) - 1))])();
  }

  /// The roots of all models that are active, as a pipeline hands them to its broad phase.
  sofa::type::vector<CollisionModel*> roots() {
    sofa::type::vector<CollisionModel*> result;
    for (const Body& body : m_bodies) {
      if (!body.model->isActive()) continue;
      body.model->computeBoundingTree(m_depth);
      result.push_back(body.model->getFirst());
    }
    return result;
  }

 private:
  struct Body {
    sofa::simulation::Node::SPtr node;
    State::SPtr state;
    CollisionModel::SPtr model;
  };
  using Way = void (ChangingScene::*)();

  int upTo(std::size_t most) { return std::uniform_int_distribution<int>(0, static_cast<int>(most))(m_random); }
  bool oneIn(int n) { return upTo(static_cast<std::size_t>(n) - 1) == 0; }
  double quarter(std::size_t most) { return 0.25 * upTo(most); }
  Vec3 anywhere() { return {quarter(20), quarter(20), quarter(20)}; }
  Body& any() { return m_bodies[static_cast<std::size_t>(upTo(m_bodies.size() - 1))]; }

  CollisionModel::SPtr newModel() {
    if (oneIn(2)) return New<geometry::PointCollisionModel<Vec3Types>>();
    return New<geometry::SphereCollisionModel<Vec3Types>>();
  }

  void addBody() {
    Body body{m_root->createChild("body"), New<State>(), newModel()};
    body.state->resize(3);
    body.node->addObject(body.state);
    body.node->addObject(body.model);
    m_bodies.push_back(body);
    place(m_bodies.back());
    m_bodies.back().node->init(sofa::core::execparams::defaultInstance());
  }
  void place(Body& body) {
    auto positions = body.state->writePositions();
    const Vec3 where = anywhere();
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = where + 0.25 * anywhere();
  }
  void removeBody() {
    if (m_bodies.size() < 3) return;
    const auto at = m_bodies.begin() + upTo(m_bodies.size() - 1);
    at->model->getContext()->removeObject(at->model);  // its node may have models of others by now
    m_bodies.erase(at);
  }
  void replaceModel() {
    Body& body = any();
    body.model->getContext()->removeObject(body.model);
    body.model = newModel();
    body.node->addObject(body.model);
    body.model->init();
  }
  void move() { place(any()); }
  void moveToAnotherNode() {
    Body& body = any();
    const auto node = oneIn(2) ? any().node : m_root->createChild("other");
    body.model->getContext()->removeObject(body.model);
    node->addObject(body.model);
  }
  void regroup() {
    if (oneIn(2)) return any().model->addGroup(upTo(2));
    any().model->setGroups({});
  }
  void setFlags() {
    any().model->setSelfCollision(oneIn(2));
    any().model->getFirst()->setSimulated(oneIn(2));
    any().model->setActive(!oneIn(3));
  }
  void setContactDistance() { any().model->setContactDistance(quarter(3)); }
  void setDepth() { m_depth = upTo(6); }
  void swapTwo() { std::swap(any(), any()); }

  static constexpr Way kWays[] = {&ChangingScene::addBody,           &ChangingScene::removeBody,
                                  &ChangingScene::replaceModel,      &ChangingScene::move,
                                  &ChangingScene::moveToAnotherNode, &ChangingScene::regroup,
                                  &ChangingScene::setFlags,          &ChangingScene::setContactDistance,
                                  &ChangingScene::setDepth,          &ChangingScene::swapTwo};

  std::mt19937 m_random;
  sofa::simulation::Node::SPtr m_root;
  std::vector<Body> m_bodies;
  int m_depth = 2;
};

void detect(BroadPhase& phase, sofa::core::collision::Intersection& method,
            const sofa::type::vector<CollisionModel*>& models) {
  phase.setIntersectionMethod(&method);
  phase.beginBroadPhase();
  phase.addCollisionModels(models);
  phase.endBroadPhase();
}

/// Runs one scene; returns how many pairs there were, and throws at the first step whose lists differ.
std::size_t run(unsigned seed, int steps, const std::string& broadPhaseClass) {
  ChangingScene scene(seed);
  sofa::core::objectmodel::BaseObjectDescription description("phase", broadPhaseClass.c_str());
  const auto made = sofa::core::ObjectFactory::CreateObject(&scene.root(), &description);
  auto* phase = dynamic_cast<BroadPhase*>(made.get());
  if (phase == nullptr) throw std::runtime_error("SOFA can't make a broad phase of the class " + broadPhaseClass);
  const auto stock = New<detection::algorithm::BruteForceBroadPhase>();
  const auto proximity = New<detection::intersection::NewProximityIntersection>();
  const auto discrete = New<detection::intersection::DiscreteIntersection>();
  proximity->init();
  discrete->init();
  std::size_t pairs = 0;
  for (int step = 0; step < steps; ++step) {
    proximity->d_alarmDistance.setValue(0.25 * (step % 3));
    for (sofa::core::collision::Intersection* method :
         {static_cast<sofa::core::collision::Intersection*>(proximity.get()),
          static_cast<sofa::core::collision::Intersection*>(discrete.get())}) {
      const auto models = scene.roots();
      detect(*phase, *method, models);
      detect(*stock, *method, models);
      if (phase->getCollisionModelPairs() != stock->getCollisionModelPairs()) {
        throw std::runtime_error("scene " + std::to_string(seed) + ": the lists of step " + std::to_string(step) +
                                 " differ");
      }
      pairs += stock->getCollisionModelPairs().size();
    }
    scene.change();
  }
  return pairs;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 4) throw std::invalid_argument("usage: sofa-changing-models SCENES STEPS CLASS [PLUGIN...]");
    const int scenes = allpairs::tools::countOf("SCENES", argv[1]);
    const int steps = allpairs::tools::countOf("STEPS", argv[2]);
    allpairs::tools::loadPlugins({argv + 4, argv + argc});
    std::size_t pairs = 0;
    for (int scene = 0; scene < scenes; ++scene) pairs += run(static_cast<unsigned>(scene), steps, argv[3]);
    std::printf("%d scenes of %d steps, two methods: %zu pairs, all lists the same\n", scenes, steps, pairs);
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "changing-models: %s\n", problem.what());
    return 1;
  }
}
