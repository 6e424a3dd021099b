// SPDX-License-Identifier: MIT
// Jolt's broad phase, its quad trees, on its own: boxes are the bounds of bodies, all of them awake, in one layer.
// In each frame the bodies that move get new bounds, the tree is updated as a step of its physics does it, and all
// awake bodies ask for their pairs.
#include <Jolt/Jolt.h>
//
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Body/BodyManager.h>
#include <Jolt/Physics/Body/BodyPair.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseQuadTree.h>
#include <Jolt/Physics/Collision/PhysicsMaterial.h>
#include <Jolt/Physics/Collision/RayCast.h>
#include <Jolt/Physics/Collision/Shape/Shape.h>
#include <Jolt/Physics/Collision/TransformedShape.h>

#include <stdexcept>

#include "MovingSearch.h"

namespace allpairs::bench {

namespace {

/// A shape of which only the bounds are asked for: those of a row, to the last bit.
class RowShape final : public JPH::Shape {
 public:
  RowShape() : Shape(JPH::EShapeType::User1, JPH::EShapeSubType::User1) {}

  void set(const float* row) { m_bounds = {JPH::Vec3(row[0], row[1], row[2]), JPH::Vec3(row[3], row[4], row[5])}; }

  JPH::AABox GetLocalBounds() const override { return m_bounds; }
  JPH::AABox GetWorldSpaceBounds(JPH::Mat44Arg /*transform*/, JPH::Vec3Arg /*scale*/) const override {
    return m_bounds;
  }

  JPH::uint GetSubShapeIDBitsRecursive() const override { return 0; }
  float GetInnerRadius() const override { return 0.0F; }
  JPH::MassProperties GetMassProperties() const override { return {}; }
  const JPH::PhysicsMaterial* GetMaterial(const JPH::SubShapeID& /*id*/) const override { return nullptr; }
  JPH::Vec3 GetSurfaceNormal(const JPH::SubShapeID& /*id*/, JPH::Vec3Arg /*position*/) const override {
    return JPH::Vec3::sZero();
  }
  void GetSubmergedVolume(JPH::Mat44Arg /*transform*/, JPH::Vec3Arg /*scale*/, const JPH::Plane& /*surface*/,
                          float& /*total*/, float& /*submerged*/,
                          JPH::Vec3& /*center*/ JPH_IF_DEBUG_RENDERER(, JPH::RVec3Arg)) const override {}
#ifdef JPH_DEBUG_RENDERER
  void Draw(JPH::DebugRenderer* /*renderer*/, JPH::RMat44Arg /*transform*/, JPH::Vec3Arg /*scale*/,
            JPH::ColorArg /*color*/, bool /*materials*/, bool /*wireframe*/) const override {}
#endif
  bool CastRay(const JPH::RayCast& /*ray*/, const JPH::SubShapeIDCreator& /*id*/,
               JPH::RayCastResult& /*hit*/) const override {
    return false;
  }
  void CastRay(const JPH::RayCast& /*ray*/, const JPH::RayCastSettings& /*settings*/,
               const JPH::SubShapeIDCreator& /*id*/, JPH::CastRayCollector& /*collector*/,
               const JPH::ShapeFilter& /*filter*/) const override {}
  void CollidePoint(JPH::Vec3Arg /*point*/, const JPH::SubShapeIDCreator& /*id*/,
                    JPH::CollidePointCollector& /*collector*/, const JPH::ShapeFilter& /*filter*/) const override {}
  void CollideSoftBodyVertices(JPH::Mat44Arg /*transform*/, JPH::Vec3Arg /*scale*/,
                               const JPH::CollideSoftBodyVertexIterator& /*vertices*/, JPH::uint /*count*/,
                               int /*index*/) const override {}
  void GetTrianglesStart(GetTrianglesContext& /*context*/, const JPH::AABox& /*box*/, JPH::Vec3Arg /*position*/,
                         JPH::QuatArg /*rotation*/, JPH::Vec3Arg /*scale*/) const override {}
  int GetTrianglesNext(GetTrianglesContext& /*context*/, int /*most*/, JPH::Float3* /*vertices*/,
                       const JPH::PhysicsMaterial** /*materials*/) const override {
    return 0;
  }
  Stats GetStats() const override { return {sizeof(*this), 0}; }
  float GetVolume() const override { return 0.0F; }

 private:
  JPH::AABox m_bounds;
};

class OneLayer final : public JPH::BroadPhaseLayerInterface {
 public:
  JPH::uint GetNumBroadPhaseLayers() const override { return 1; }
  JPH::BroadPhaseLayer GetBroadPhaseLayer(JPH::ObjectLayer /*layer*/) const override { return JPH::BroadPhaseLayer(0); }
#if defined(JPH_EXTERNAL_PROFILE) || defined(JPH_PROFILE_ENABLED)
  const char* GetBroadPhaseLayerName(JPH::BroadPhaseLayer /*layer*/) const override { return "all"; }
#endif
};

class PairCollector final : public JPH::BodyPairCollector {
 public:
  explicit PairCollector(std::vector<Pair>& pairs) : m_pairs(pairs) {}
  void AddHit(const JPH::BodyPair& pair) override {
    m_pairs.push_back({pair.mBodyA.GetIndex(), pair.mBodyB.GetIndex()});
  }

 private:
  std::vector<Pair>& m_pairs;
};

class JoltSteps final : public MovingSearch {
 public:
  void start(const MovingScene& scene) override {
    const auto count = static_cast<JPH::uint>(scene.rows().size() / 6);
    m_manager.Init(count, 0, m_layer);
    m_tree.Init(&m_manager, m_layer);
    for (JPH::uint i = 0; i < count; ++i) {
      m_shapes.push_back(new RowShape);
      m_shapes[i]->set(scene.rows().data() + std::size_t{6} * i);
      JPH::BodyCreationSettings settings(m_shapes[i].GetPtr(), JPH::RVec3::sZero(), JPH::Quat::sIdentity(),
                                         JPH::EMotionType::Dynamic, 0);
      settings.mOverrideMassProperties = JPH::EOverrideMassProperties::MassAndInertiaProvided;
      settings.mMassPropertiesOverride.mMass = 1.0F;
      settings.mMassPropertiesOverride.mInertia = JPH::Mat44::sIdentity();
      JPH::Body* const body = m_manager.AllocateBody(settings);
      if (body == nullptr || !m_manager.AddBody(body)) throw std::runtime_error("Jolt gives no more bodies");
      m_bodies.push_back(body);
      m_ids.push_back(body->GetID());
      if (m_ids[i].GetIndex() != i) throw std::runtime_error("Jolt numbers bodies otherwise");
    }
    std::vector<JPH::BodyID> added = m_ids;  // It puts them in an order of its own.
    const JPH::BroadPhase::AddState state = m_tree.AddBodiesPrepare(added.data(), static_cast<int>(count));
    m_tree.AddBodiesFinalize(added.data(), static_cast<int>(count), state);
    m_manager.ActivateBodies(m_ids.data(), static_cast<int>(count));
    m_tree.Optimize();
    findPairs();
  }

  void step(const MovingScene& scene) override {
    m_moved.clear();
    for (const BoxId id : scene.movingIds()) {
      m_shapes[id]->set(scene.rows().data() + std::size_t{6} * id);
      m_bodies[id]->CalculateWorldSpaceBoundsInternal();
      m_moved.push_back(m_ids[id]);
    }
    m_tree.NotifyBodiesAABBChanged(m_moved.data(), static_cast<int>(m_moved.size()), true);
    m_tree.FrameSync();
    m_tree.LockModifications();
    m_tree.UpdateFinalize(m_tree.UpdatePrepare());
    m_tree.UnlockModifications();
    findPairs();
  }

  void collect(const MovingScene& /*scene*/, std::vector<Pair>& pairs) override { pairs = m_pairs; }

 private:
  void findPairs() {
    m_pairs.clear();
    m_active = m_ids;
    PairCollector collector(m_pairs);
    m_tree.FindCollidingPairs(m_active.data(), static_cast<int>(m_active.size()), 0.0F,
                              JPH::ObjectVsBroadPhaseLayerFilter(), JPH::ObjectLayerPairFilter(), collector);
  }

  OneLayer m_layer;
  std::vector<JPH::Ref<RowShape>> m_shapes;
  JPH::BodyManager m_manager;  ///< Destroys the bodies.
  JPH::BroadPhaseQuadTree m_tree;
  std::vector<JPH::Body*> m_bodies;
  std::vector<JPH::BodyID> m_ids;
  std::vector<JPH::BodyID> m_moved;
  std::vector<JPH::BodyID> m_active;
  std::vector<Pair> m_pairs;
};

}  // namespace

void addJoltContenders(std::vector<MovingContender>& contenders) {
  JPH::RegisterDefaultAllocator();
  contenders.push_back({"Jolt", "quad tree", [] { return std::make_unique<JoltSteps>(); }});
}

}  // namespace allpairs::bench
