// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "SceneSpec.h"
#include "allpairs/collision/BoundingBoxModel.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "allpairs/collision/MinProximityIntersection.h"

namespace allpairs::test {

/// The least that a user's model must say.
class UserModel : public collision::CollisionModel {
 public:
  explicit UserModel(const Box& box, std::size_t size = 1) : m_box(box), m_size(size) {}
  [[nodiscard]] std::size_t getSize() const override { return m_size; }
  [[nodiscard]] Box elementBox(std::size_t /*index*/) const override { return m_box; }

 private:
  Box m_box;
  std::size_t m_size;
};

class PickyModel : public UserModel {
 public:
  using UserModel::UserModel;
  [[nodiscard]] bool canCollideWith(collision::CollisionModel* other) override { return other->getSelfCollision(); }
};

class OddModel : public UserModel {
 public:
  using UserModel::UserModel;
  [[nodiscard]] std::type_index rootTypeKey() const override { return typeid(OddModel); }
};

/// Serves (Odd, other) and minds which of the two comes first.
class OddIntersector : public collision::BoxIntersector {
 public:
  [[nodiscard]] bool canIntersect(const collision::CollisionElement& first, const collision::CollisionElement& second,
                                  const collision::Intersection& method) const override {
    return first.box().min[0] <= second.box().min[0] && BoxIntersector::canIntersect(first, second, method);
  }
};

class YIntersector : public collision::ElementIntersector {
 public:
  [[nodiscard]] bool canIntersect(const collision::CollisionElement& first, const collision::CollisionElement& second,
                                  const collision::Intersection& /*method*/) const override {
    return first.box().min[1] <= second.box().max[1];
  }
};

class UserBoundedMethod : public collision::MinProximityIntersection {};

class UserUnboundedMethod : public collision::Intersection {
 public:
  UserUnboundedMethod() {
    add<collision::BoundingBoxModel, collision::BoundingBoxModel>(std::make_shared<YIntersector>());
  }
};

/// A test scene as real models and a real method.
class SceneWorld {
 public:
  explicit SceneWorld(const SceneSpec& spec) : m_spec(spec), m_method(makeMethod(spec)) {
    const bool unbounded = spec.method == Method::UserUnbounded;
    std::shared_ptr<collision::ElementIntersector> serves = std::make_shared<OddIntersector>();
    if (unbounded) serves = std::make_shared<YIntersector>();
    m_method->add<OddModel, collision::BoundingBoxModel>(serves);
    m_method->setAlarmDistance(spec.alarm);
    for (const ModelSpec& model : spec.models) addModel(model);
  }

  [[nodiscard]] const std::vector<collision::CollisionModel*>& models() const { return m_models; }
  [[nodiscard]] collision::Intersection& method() { return *m_method; }

  void prepare(collision::BruteForceBroadPhase& phase) const {
    phase.setIntersectionMethod(m_method.get());
    phase.clearBox();
    if (m_spec.region) phase.setBox(*m_spec.region);
    phase.init();
  }

  /// Pairs as the places at which the two models come in the scene; of one that comes again, the first.
  [[nodiscard]] std::vector<IndexPair> indices(const std::vector<collision::CollisionModelPair>& pairs) const {
    std::vector<IndexPair> result;
    for (const auto& [first, second] : pairs) result.emplace_back(placeOf(first), placeOf(second));
    return result;
  }

  /// The oracle's pairs under the same numbers.
  [[nodiscard]] std::vector<IndexPair> firstPlaces(std::vector<IndexPair> pairs) const {
    for (auto& [first, second] : pairs) {
      first = placeOf(m_models[first]);
      second = placeOf(m_models[second]);
    }
    return pairs;
  }

 private:
  static std::unique_ptr<collision::Intersection> makeMethod(const SceneSpec& spec) {
    if (spec.method == Method::Discrete) return std::make_unique<collision::DiscreteIntersection>();
    if (spec.method == Method::UserBounded) return std::make_unique<UserBoundedMethod>();
    if (spec.method == Method::UserUnbounded) return std::make_unique<UserUnboundedMethod>();
    auto method = std::make_unique<collision::MinProximityIntersection>();
    method->setContactDistanceInBroadPhase(spec.method == Method::Proximity);
    return method;
  }

  static std::unique_ptr<collision::CollisionModel> makeModel(const ModelSpec& spec) {
    if (spec.kind == Kind::User) return std::make_unique<UserModel>(spec.box);
    if (spec.kind == Kind::Picky) return std::make_unique<PickyModel>(spec.box);
    if (spec.kind == Kind::Odd) return std::make_unique<OddModel>(spec.box);
    if (spec.kind == Kind::Empty) return std::make_unique<UserModel>(spec.box, 0);
    return std::make_unique<collision::BoxModel>("", spec.box);
  }

  void addModel(const ModelSpec& spec) {
    if (spec.again || spec.kind == Kind::Null) {
      m_models.push_back(spec.again && !m_models.empty() ? m_models.back() : nullptr);
      return;
    }
    m_owned.push_back(makeModel(spec));
    collision::CollisionModel& model = *m_owned.back();
    model.setSimulated(spec.simulated);
    model.setSelfCollision(spec.self);
    model.setGroups(spec.groups);
    model.setContactDistance(spec.contact);
    model.setOwner(spec.owner == 0 ? nullptr : &m_owners[static_cast<std::size_t>(spec.owner)]);
    m_models.push_back(&model);
  }

  [[nodiscard]] std::size_t placeOf(const collision::CollisionModel* model) const {
    const auto found = std::find(m_models.begin(), m_models.end(), model);
    return static_cast<std::size_t>(found - m_models.begin());
  }

  SceneSpec m_spec;
  std::unique_ptr<collision::Intersection> m_method;
  std::array<char, 256> m_owners{};
  std::vector<std::unique_ptr<collision::CollisionModel>> m_owned;
  std::vector<collision::CollisionModel*> m_models;
};

}  // namespace allpairs::test
