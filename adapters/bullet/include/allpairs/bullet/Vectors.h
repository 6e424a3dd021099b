// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <LinearMath/btVector3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/WorldTypes.h"

/// Bullet's vectors and boxes as the broad phase needs them: an implementation detail.
namespace allpairs::internal {

[[nodiscard]] inline std::array<double, 3> toArray(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

[[nodiscard]] inline Box toBox(const btVector3& min, const btVector3& max) { return {toArray(min), toArray(max)}; }

/// With a margin on all sides, unless it is empty.
[[nodiscard]] inline Box toWidenedBox(const btVector3& min, const btVector3& max, btScalar margin) {
  const Box box = toBox(min, max);
  if (isEmpty(box)) return box;
  const btVector3 more(margin, margin, margin);
  return toBox(min - more, max + more);
}

[[nodiscard]] inline bool isFinite(const std::array<double, 3>& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

[[nodiscard]] inline bool areFinite(std::initializer_list<btVector3> points) {
  return std::all_of(points.begin(), points.end(), [](const btVector3& point) { return isFinite(toArray(point)); });
}

/// A box that is moved from one place to another. Bullet's own sums are rounded to its precision.
[[nodiscard]] inline BoxSweep sweepOf(const Box& box, const btVector3& from, const btVector3& to) {
  const std::array<double, 3> start = toArray(from);
  BoxSweep sweep{box, toArray(to)};
  for (std::size_t k = 0; k < 3; ++k) {
    sweep.box.min[k] += start[k];
    sweep.box.max[k] += start[k];
    sweep.motion[k] -= start[k];
  }
  return sweep;
}

/// From near to far, without those that are never met.
inline void sortHits(std::vector<SweepHit>& hits) {
  const auto isMissed = [](const SweepHit& hit) { return !std::isfinite(hit.t); };
  hits.erase(std::remove_if(hits.begin(), hits.end(), isMissed), hits.end());
  std::sort(hits.begin(), hits.end(),
            [](const SweepHit& a, const SweepHit& b) { return a.t != b.t ? a.t < b.t : a.id < b.id; });
}

[[nodiscard]] inline bool overlap(const btBroadphaseProxy& proxy, const btVector3& min, const btVector3& max) {
  for (int axis = 0; axis < 3; ++axis) {
    if (proxy.m_aabbMin[axis] > max[axis] || min[axis] > proxy.m_aabbMax[axis]) return false;
  }
  return true;
}

[[nodiscard]] inline btVector3 minimum(btVector3 a, const btVector3& b) {
  a.setMin(b);
  return a;
}

[[nodiscard]] inline btVector3 maximum(btVector3 a, const btVector3& b) {
  a.setMax(b);
  return a;
}

}  // namespace allpairs::internal
