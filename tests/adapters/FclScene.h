// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "allpairs/fcl/FclBroadPhaseManager.h"

namespace allpairs::test {

/// The precisions that FCL comes in.
using FclPrecisions = ::testing::Types<float, double>;

inline constexpr unsigned kSceneSeed = 5;

/// Objects, and a manager of ours beside a naive one.
template <class S>
class FclScene : public ::testing::Test {
 protected:
  using Object = ::fcl::CollisionObject<S>;
  using Base = ::fcl::BroadPhaseCollisionManager<S>;
  using Pairs = std::vector<std::pair<Object*, Object*>>;

  /// Objects of two shapes, turned at random, in a cube of this size.
  std::vector<Object*> addObjects(std::size_t count, S size) {
    std::vector<Object*> objects;
    for (std::size_t i = 0; i < count; ++i) {
      std::shared_ptr<::fcl::CollisionGeometry<S>> shape;
      if (i % 2 == 0) shape = std::make_shared<::fcl::Box<S>>(S(0.5), S(1), S(1.5));
      if (i % 2 != 0) shape = std::make_shared<::fcl::Sphere<S>>(S(0.5));
      m_owned.push_back(std::make_unique<Object>(shape));
      objects.push_back(m_owned.back().get());
      place(*objects.back(), size);
    }
    return objects;
  }

  void place(Object& object, S size) {
    object.setTranslation({number(size), number(size), number(size)});
    object.setQuatRotation(::fcl::Quaternion<S>(number(1), number(1), number(1), S(0.1)).normalized());
    object.computeAABB();
  }

  S number(S most) { return std::uniform_real_distribution<S>(0, most)(m_random); }

  /// Collects the pairs that the objects' shapes have in common.
  static bool collideShapes(Object* a, Object* b, void* data) {
    if (distanceOf(a, b) <= S(0)) static_cast<Pairs*>(data)->push_back(std::minmax(a, b));
    return false;
  }

  /// Keeps the least distance of shapes.
  static bool measureShapes(Object* a, Object* b, void* data, S& least) {
    S& known = *static_cast<S*>(data);
    known = std::min(known, distanceOf(a, b));
    least = known;
    return known <= S(0);
  }

  /// By FCL in double; in float, for which its library has nothing compiled, of the balls around the shapes.
  static S distanceOf(Object* a, Object* b) {
    if constexpr (std::is_same_v<S, double>) {
      ::fcl::DistanceResult<S> result;
      ::fcl::distance(a, b, ::fcl::DistanceRequest<S>(), result);
      return std::max(result.min_distance, S(0));
    } else {
      const S radii = S(0.5) + S(0.5);
      return std::max((a->getTranslation() - b->getTranslation()).norm() - radii, S(0));
    }
  }

  static Pairs sorted(Pairs pairs) {
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  static Pairs collisions(const Base& manager) {
    Pairs pairs;
    manager.collide(&pairs, collideShapes);
    return sorted(std::move(pairs));
  }

  template <class Other>
  static Pairs collisions(const Base& manager, Other* other) {
    Pairs pairs;
    manager.collide(other, &pairs, collideShapes);
    return sorted(std::move(pairs));
  }

  static S distance(const Base& manager) {
    S least = std::numeric_limits<S>::max();
    manager.distance(&least, measureShapes);
    return least;
  }

  template <class Other>
  static S distance(const Base& manager, Other* other) {
    S least = std::numeric_limits<S>::max();
    manager.distance(other, &least, measureShapes);
    return least;
  }

  FclBroadPhaseManager<S> m_ours;
  ::fcl::NaiveCollisionManager<S> m_naive;

 private:
  std::mt19937 m_random{kSceneSeed};
  std::vector<std::unique_ptr<Object>> m_owned;
};

/// An object whose box is as given.
template <class S>
class BoxedObject : public ::fcl::CollisionObject<S> {
 public:
  BoxedObject(S min, S max) : ::fcl::CollisionObject<S>(std::make_shared<::fcl::Sphere<S>>(S(1))) { set(min, max); }

  /// From min to max on every axis.
  void set(S min, S max) {
    this->aabb.min_.setConstant(min);
    this->aabb.max_.setConstant(max);
  }
  void set(int axis, S min, S max) {
    this->aabb.min_[axis] = min;
    this->aabb.max_[axis] = max;
  }
};

}  // namespace allpairs::test
