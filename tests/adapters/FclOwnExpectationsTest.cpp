// SPDX-License-Identifier: MIT
// What FCL's own tests expect of a manager, with its own callbacks, shapes and meshes: the results of its naive
// manager, when objects were registered and after they moved.
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/geometry/geometric_shape_to_BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "allpairs/fcl/FclBroadPhaseManager.h"

namespace allpairs::test {
namespace {

using Object = ::fcl::CollisionObjectd;
using Manager = ::fcl::BroadPhaseCollisionManagerd;
using Geometry = ::fcl::CollisionGeometryd;

constexpr unsigned kEnvironmentSeed = 17;
constexpr double kScale = 40.0;  // objects lie in a cube of twice this size

/// The shapes of FCL's own tests, a few times smaller, or meshes of them.
std::shared_ptr<Geometry> makeGeometry(std::size_t kind, bool isMesh) {
  const ::fcl::Boxd box(5.0, 10.0, 20.0);
  const ::fcl::Sphered ball(5.0);
  const ::fcl::Cylinderd rod(2.0, 14.0);
  if (!isMesh && kind == 0) return std::make_shared<::fcl::Boxd>(box);
  if (!isMesh && kind == 1) return std::make_shared<::fcl::Sphered>(ball);
  if (!isMesh) return std::make_shared<::fcl::Cylinderd>(rod);
  auto mesh = std::make_shared<::fcl::BVHModel<::fcl::OBBRSSd>>();
  const ::fcl::Transform3d nowhere = ::fcl::Transform3d::Identity();
  if (kind == 0) ::fcl::generateBVHModel(*mesh, box, nowhere);
  if (kind == 1) ::fcl::generateBVHModel(*mesh, ball, nowhere, 8U, 8U);
  if (kind == 2) ::fcl::generateBVHModel(*mesh, rod, nowhere, 8U, 8U);
  return mesh;
}

/// Objects in a naive manager and in ours, and others to ask about.
class FclOwnExpectations : public ::testing::TestWithParam<bool> {
 protected:
  FclOwnExpectations() {
    for (std::size_t i = 0; i < 60; ++i) m_objects.push_back(makeObject(i));
    for (std::size_t i = 0; i < 12; ++i) m_queries.push_back(makeObject(i));
    for (Manager* manager : {static_cast<Manager*>(&m_naive), static_cast<Manager*>(&m_ours)}) {
      manager->registerObjects(pointers(m_objects));
      manager->setup();
    }
  }

  /// A quarter of a turn at most, and a tenth of the scene.
  void moveAll() {
    for (const auto& object : m_objects) {
      object->setTranslation(object->getTranslation() + kScale / 10.0 * direction());
      object->setRotation(turn(std::numbers::pi / 2.0) * object->getRotation());
      object->computeAABB();
    }
    m_naive.update();
    m_ours.update();
    m_naive.setup();
    m_ours.setup();
  }

  [[nodiscard]] std::vector<Object*> queries() const { return pointers(m_queries); }

  static std::vector<Object*> pointers(const std::vector<std::unique_ptr<Object>>& objects) {
    std::vector<Object*> result;
    for (const auto& object : objects) result.push_back(object.get());
    return result;
  }

  ::fcl::NaiveCollisionManagerd m_naive;
  FclBroadPhaseManagerd m_ours;

 private:
  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(m_random); }
  ::fcl::Vector3d direction() { return {number(), number(), number()}; }

  ::fcl::Matrix3d turn(double most) {
    return ::fcl::AngleAxisd(most * number(), direction().normalized()).toRotationMatrix();
  }

  std::unique_ptr<Object> makeObject(std::size_t i) {
    auto object = std::make_unique<Object>(makeGeometry(i % 3, GetParam()));
    object->setTranslation(kScale * direction());
    object->setRotation(turn(std::numbers::pi));
    object->computeAABB();
    return object;
  }

  std::mt19937 m_random{kEnvironmentSeed};
  std::vector<std::unique_ptr<Object>> m_objects;
  std::vector<std::unique_ptr<Object>> m_queries;
};

using Contacts = std::vector<std::pair<const Geometry*, const Geometry*>>;

/// The geometries of each contact, as many times as they have one.
Contacts contactsOf(const ::fcl::CollisionResultd& result) {
  Contacts contacts;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    contacts.push_back(std::minmax(result.getContact(i).o1, result.getContact(i).o2));
  }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

/// `with` is nothing, an object or another manager.
template <class... With>
Contacts contacts(const Manager& manager, With*... with) {
  ::fcl::DefaultCollisionData<double> data;
  data.request.num_max_contacts = 100000;
  manager.collide(with..., &data, ::fcl::DefaultCollisionFunction<double>);
  return contactsOf(data.result);
}

template <class... With>
bool isCollision(const Manager& manager, With*... with) {
  ::fcl::DefaultCollisionData<double> data;  // one contact ends it
  manager.collide(with..., &data, ::fcl::DefaultCollisionFunction<double>);
  return data.result.isCollision();
}

template <class... With>
double distance(const Manager& manager, With*... with) {
  ::fcl::DefaultDistanceData<double> data;
  manager.distance(with..., &data, ::fcl::DefaultDistanceFunction<double>);
  return data.result.min_distance;
}

TEST_P(FclOwnExpectations, CollisionsAreThoseOfTheNaiveManagerAlsoAfterMoving) {
  for (int step = 0; step < 3; ++step) {
    ASSERT_FALSE(contacts(m_naive).empty()) << "seed " << kEnvironmentSeed;
    EXPECT_EQ(contacts(m_ours), contacts(m_naive)) << "seed " << kEnvironmentSeed << ", step " << step;
    EXPECT_TRUE(isCollision(m_ours));
    for (Object* query : queries()) {
      EXPECT_EQ(contacts(m_ours, query), contacts(m_naive, query));
      EXPECT_EQ(isCollision(m_ours, query), isCollision(m_naive, query));
    }
    moveAll();
  }
}

TEST_P(FclOwnExpectations, DistancesAreThoseOfTheNaiveManagerAlsoAfterMoving) {
  double most = 0.0;
  for (int step = 0; step < 3; ++step) {
    EXPECT_NEAR(distance(m_ours), distance(m_naive), 1e-6) << "seed " << kEnvironmentSeed << ", step " << step;
    for (Object* query : queries()) {
      // Apart from the scene too, where a least distance is to be found. FCL's distance depends on which object is the
      // first, and a query is that of the naive manager.
      EXPECT_NEAR(distance(m_ours, query), distance(m_naive, query), 1e-5);
      query->setTranslation(query->getTranslation() + ::fcl::Vector3d(kScale, kScale, kScale));
      query->computeAABB();
      EXPECT_NEAR(distance(m_ours, query), distance(m_naive, query), 1e-5);
      most = std::max(most, distance(m_naive, query));
    }
    moveAll();
  }
  EXPECT_GT(most, 1.0) << "nothing was apart; seed " << kEnvironmentSeed;
}

TEST_P(FclOwnExpectations, ManagersMeetAsNaiveOnesDo) {
  ::fcl::NaiveCollisionManagerd naiveOther;
  FclBroadPhaseManagerd other;
  naiveOther.registerObjects(queries());
  other.registerObjects(queries());
  const auto expected = contacts(m_naive, static_cast<Manager*>(&naiveOther));
  ASSERT_FALSE(expected.empty()) << "seed " << kEnvironmentSeed;
  EXPECT_EQ(contacts(m_ours, static_cast<Manager*>(&other)), expected);
  EXPECT_EQ(contacts(m_ours, static_cast<Manager*>(&naiveOther)), expected);
  EXPECT_NEAR(distance(m_ours, static_cast<Manager*>(&other)), distance(m_naive, static_cast<Manager*>(&naiveOther)),
              1e-6);
}

INSTANTIATE_TEST_SUITE_P(Kinds, FclOwnExpectations, ::testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Meshes" : "Shapes"; });

}  // namespace
}  // namespace allpairs::test
