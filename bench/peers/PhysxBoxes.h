// SPDX-License-Identifier: MIT
// What the contenders that use PhysX share: its foundation, and boxes in the arrays that its broad phase reads.
#pragma once

#include <PxBroadPhase.h>
#include <extensions/PxDefaultAllocator.h>
#include <foundation/PxErrorCallback.h>
#include <foundation/PxFoundation.h>
#include <foundation/PxPhysicsVersion.h>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

namespace allpairs::bench {

class PhysxErrors final : public physx::PxErrorCallback {
 public:
  void reportError(physx::PxErrorCode::Enum code, const char* message, const char* /*file*/, int /*line*/) override {
    std::fprintf(stderr, "PhysX: %s (%d)\n", message, static_cast<int>(code));
  }
};

struct PhysxDeleter {
  void operator()(physx::PxBroadPhase* broadPhase) const { broadPhase->release(); }
};
using PhysxBroadPhase = std::unique_ptr<physx::PxBroadPhase, PhysxDeleter>;

/// PhysX allows one foundation a process; it stays.
inline PhysxBroadPhase makePhysxBroadPhase() {
  static physx::PxDefaultAllocator allocator;
  static PhysxErrors errors;
  static const physx::PxFoundation* const foundation = PxCreateFoundation(PX_PHYSICS_VERSION, allocator, errors);
  if (foundation == nullptr) throw std::runtime_error("PhysX gives no foundation");
  return PhysxBroadPhase(PxCreateBroadPhase(physx::PxBroadPhaseDesc(physx::PxBroadPhaseType::eABP)));
}

/// Boxes as PhysX's broad phase reads them.
class PhysxBoxes {
 public:
  /// Appends boxes, rows of 6. Those of one set get a filter group each; those of two the group of their set, since
  /// PhysX pairs nothing within a group.
  void append(std::span<const float> rows, bool ownGroups) {
    const std::size_t begin = m_groups.size();
    const std::size_t end = begin + rows.size() / 6;
    // It may load four bytes past the last of the bounds.
    m_bounds.resize(end + 1);
    for (std::size_t i = begin; i < end; ++i) {
      set(i, rows.data() + 6 * (i - begin));
      m_groups.push_back(physx::PxGetBroadPhaseDynamicFilterGroup(static_cast<physx::PxU32>(ownGroups ? i : begin)));
    }
    m_distances.resize(end);
    m_ids.resize(end);
    std::iota(m_ids.begin(), m_ids.end(), 0U);
  }

  void set(std::size_t i, const float* row) {
    m_bounds[i] = physx::PxBounds3({row[0], row[1], row[2]}, {row[3], row[4], row[5]});
  }

  /// All boxes as new ones.
  [[nodiscard]] physx::PxBroadPhaseUpdateData creation() const {
    const auto count = static_cast<physx::PxU32>(m_ids.size());
    return {m_ids.data(), count, nullptr, 0, nullptr, 0, m_bounds.data(), m_groups.data(), m_distances.data(), count};
  }

  /// Boxes that have moved.
  [[nodiscard]] physx::PxBroadPhaseUpdateData update(std::span<const physx::PxBpIndex> moved) const {
    return {nullptr,
            0,
            moved.data(),
            static_cast<physx::PxU32>(moved.size()),
            nullptr,
            0,
            m_bounds.data(),
            m_groups.data(),
            m_distances.data(),
            static_cast<physx::PxU32>(m_ids.size())};
  }

 private:
  std::vector<physx::PxBounds3> m_bounds;
  std::vector<physx::PxBpFilterGroup> m_groups;
  std::vector<float> m_distances;
  std::vector<physx::PxBpIndex> m_ids;
};

}  // namespace allpairs::bench
