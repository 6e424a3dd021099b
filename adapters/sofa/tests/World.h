// SPDX-License-Identifier: MIT
#pragma once

#include <Allpairs/AllpairsBroadPhase.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sofa/component/collision/detection/algorithm/BruteForceBroadPhase.h>
#include <sofa/component/collision/detection/intersection/DiscreteIntersection.h>
#include <sofa/component/collision/detection/intersection/LocalMinDistance.h>
#include <sofa/component/collision/detection/intersection/MinProximityIntersection.h>
#include <sofa/component/collision/detection/intersection/NewProximityIntersection.h>
#include <sofa/component/collision/geometry/TriangleCollisionModel.h>

#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace allpairs::test {

namespace intersection = sofa::component::collision::detection::intersection;
using sofa::component::collision::detection::algorithm::BruteForceBroadPhase;
using sofa::component::collision::geometry::CubeCollisionModel;
using Triangles = sofa::component::collision::geometry::TriangleCollisionModel<sofa::defaulttype::Vec3Types>;
using sofa::type::Vec3;

using Numbers = std::vector<std::pair<int, int>>;

/// A model of two levels, a box above elements, as SOFA's models are in the broad phase.
struct Body {
  sofa::core::CollisionModel::SPtr root;
  sofa::core::CollisionModel::SPtr elements;

  [[nodiscard]] CubeCollisionModel& box() const { return static_cast<CubeCollisionModel&>(*root); }
};

/// Bodies in the order in which they are added, and the lists that the stock broad phase and ours make of them.
class World {
 public:
  /// Adds a body in a node of its own, with elements of the given type.
  template <class Elements = Triangles>
  Body& add(const Vec3& min, const Vec3& max) {
    auto root = sofa::core::objectmodel::New<CubeCollisionModel>();
    root->resize(1);
    root->setParentOf(0, min, max);
    return addBody(root, new Elements);
  }

  Body& addBody(sofa::core::CollisionModel::SPtr root, sofa::core::CollisionModel::SPtr elements) {
    Body& body = m_bodies.emplace_back(Body{std::move(root), std::move(elements)});
    body.elements->resize(1);
    body.elements->setContext(&m_nodes.emplace_back());
    body.elements->setPrevious(body.root);
    body.elements->setName(std::to_string(m_bodies.size() - 1));
    m_models.push_back(body.root.get());
    return body;
  }

  /// Adds a unit box that begins at x.
  Body& addAt(double x) { return add({x, 0.0, 0.0}, {x + 1.0, 1.0, 1.0}); }

  void addAgain(const Body& body) { m_models.push_back(body.root.get()); }

  /// Lets go of a body.
  void remove(std::size_t body) {
    m_bodies.erase(m_bodies.begin() + static_cast<std::ptrdiff_t>(body));
    setModels({});
  }

  /// The models of the steps to come, in this order.
  void setModels(std::vector<sofa::core::CollisionModel*> models) { m_models = std::move(models); }

  sofa::core::objectmodel::BaseContext& newNode() { return m_nodes.emplace_back(); }

  /// What a broad phase makes of the models, handed over together or one by one.
  Numbers run(sofa::core::collision::BroadPhaseDetection& phase, sofa::core::collision::Intersection& method,
              bool oneByOne = false) {
    phase.setIntersectionMethod(&method);
    phase.beginBroadPhase();
    if (!oneByOne) phase.addCollisionModels(m_models);
    for (std::size_t i = 0; oneByOne && i < m_models.size(); ++i) phase.addCollisionModel(m_models[i]);
    phase.endBroadPhase();
    return numbers(phase.getCollisionModelPairs());
  }

  Numbers runStock(sofa::core::collision::Intersection& method) {
    const auto stock = sofa::core::objectmodel::New<BruteForceBroadPhase>();
    stock->d_box.copyValueFrom(&ours().d_box);
    return run(*stock, method);
  }

  /// What ours makes of it, which must be what the stock one makes of it.
  Numbers runBoth(sofa::core::collision::Intersection& method) {
    Numbers result = run(ours(), method);
    EXPECT_EQ(result, runStock(method));
    EXPECT_EQ(run(ours(), method, true), result) << "one by one";
    return result;
  }

  plugin::AllpairsBroadPhase& ours() { return *m_ours; }
  std::deque<Body>& bodies() { return m_bodies; }

 private:
  [[nodiscard]] Numbers numbers(
      const std::vector<sofa::core::collision::BroadPhaseDetection::CollisionModelPair>& pairs) const {
    const auto numberOf = [this](const sofa::core::CollisionModel* model) {
      return static_cast<int>(std::find(m_models.begin(), m_models.end(), model) - m_models.begin());
    };
    Numbers result;
    for (const auto& [first, second] : pairs) result.emplace_back(numberOf(first), numberOf(second));
    return result;
  }

  std::deque<Body> m_bodies;
  std::deque<sofa::core::objectmodel::BaseContext> m_nodes;
  std::vector<sofa::core::CollisionModel*> m_models;
  plugin::AllpairsBroadPhase::SPtr m_ours = sofa::core::objectmodel::New<plugin::AllpairsBroadPhase>();
};

/// A method of the user's own, which finds near what lies within 1 along x, however far apart elsewhere; it wants the
/// body that lies further left first.
class SlabMethod : public intersection::BoxMethod {
 public:
  SlabMethod() { addBoxTest(*this); }

  sofa::core::collision::ElementIntersector* findIntersector(sofa::core::CollisionModel* first,
                                                             sofa::core::CollisionModel* second, bool& swap) override {
    auto* found = BoxMethod::findIntersector(first, second, swap);
    swap = found != nullptr && left(*first) > left(*second);
    return found;
  }

  bool testIntersection(const intersection::Cube& first, const intersection::Cube& second,
                        const sofa::core::collision::Intersection* /*current*/) {
    ++asked;
    return second.data().minBBox[0] - first.data().maxBBox[0] <= 1.0;
  }

  int asked = 0;

 private:
  static double left(sofa::core::CollisionModel& model) {
    return static_cast<CubeCollisionModel&>(model).getCubeData(0).minBBox[0];
  }
};

}  // namespace allpairs::test
