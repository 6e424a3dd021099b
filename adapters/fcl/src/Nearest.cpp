// SPDX-License-Identifier: MIT
#include "Nearest.h"

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

namespace allpairs::exact {
namespace {

const ::fcl::DistanceRequestd kWithPoints(true);
const ::fcl::Transform3d kInPlace = ::fcl::Transform3d::Identity();

Nearest unscaled(double distance, const ::fcl::DistanceResultd& result) {
  return {.distance = std::max(0.0, distance) / kHierarchyScale,
          .onFirst = result.nearest_points[0] / kHierarchyScale,
          .onSecond = result.nearest_points[1] / kHierarchyScale,
          .triangle = std::ptrdiff_t{result.b1}};
}

}  // namespace

Nearest nearest(const ExactPart& first, const ExactPart& second) {
  ::fcl::DistanceResultd result;
  const double distance =
      ::fcl::distance(&first.hierarchy(), kInPlace, &second.hierarchy(), kInPlace, kWithPoints, result);
  return unscaled(distance, result);
}

Nearest nearest(const ExactPart& part, const Point& point) {
  const ::fcl::Sphered ball(0.0);
  ::fcl::Transform3d pose = kInPlace;
  pose.translation() = point * kHierarchyScale;
  ::fcl::DistanceResultd result;
  const double distance = ::fcl::distance(&part.hierarchy(), kInPlace, &ball, pose, kWithPoints, result);
  return unscaled(distance, result);
}

}  // namespace allpairs::exact
