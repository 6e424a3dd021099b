// SPDX-License-Identifier: MIT
#include "Thick.h"

#include <algorithm>

#include "Inside.h"
#include "PointTriangle.h"

namespace allpairs::exact {
namespace {

/// From the begin of a capsule's core to its end; zero of a ball, and of a core so short that its direction is lost.
Point coreOf(const ExactPart& thick) {
  constexpr double kLeastSquare = 1e-290;
  const Corners& corners = thick.triangles().front();
  const Point core = corners[1] - corners[0];
  return core.squaredNorm() < kLeastSquare ? Point(Point::Zero()) : core;
}

Point between(const ExactPart& first, const ExactPart& second) {
  return (toPoint(first.box().min) + toPoint(first.box().max) - toPoint(second.box().min) - toPoint(second.box().max)) /
         2.0;
}

/// A direction across both cores, in which the surface of either lies beside any point of it.
Point acrossCores(const Point& first, const Point& second) {
  constexpr double kParallel = 1e-9;
  const Point across = first.stableNormalized().cross(second.stableNormalized());
  if (across.norm() > kParallel) return across.normalized();
  const Point& core = first.squaredNorm() >= second.squaredNorm() ? first : second;
  return core.isZero(0.0) ? Point(Point::UnitZ()) : Point(core.unitOrthogonal());
}

/// Away from a part that is not thick at a point of it: across a triangle there, out of a solid, or to where a thick
/// part mostly lies.
Point awayFrom(const ExactPart& thin, const ExactPart& thick, const Point& at, double tolerance) {
  for (std::size_t i = 0; i < thin.triangles().size(); ++i) {
    const Corners& corners = thin.triangles()[i];
    if (!overlap(thin.triangleBoxes()[i], {toVec3(at), toVec3(at)}, tolerance) || !hasArea(corners)) continue;
    if ((nearestPoint(corners, at) - at).norm() > tolerance) continue;
    const Point normal = normalOf(corners).normalized();
    const bool isTurned =
        thin.volume() != Volume::None
            ? isInside(thin, at + 4.0 * tolerance * normal)
            : normal.dot(toPoint(thick.box().min) - at) + normal.dot(toPoint(thick.box().max) - at) < 0.0;
    return isTurned ? Point(-normal) : normal;
  }
  return between(thick, thin);
}

/// The direction nearest to the wanted one in which the surface of a ball or a capsule lies beside a point of its core:
/// across it, or at an end beyond it. Length 1.
Point besideCore(const ExactPart& thick, const Point& at, Point direction, double tolerance) {
  direction.stableNormalize();
  const Point core = coreOf(thick);
  if (!core.isZero(0.0)) {
    const Point unit = core.normalized();
    const double along = direction.dot(unit);
    const Point& end = thick.triangles().front()[along > 0.0 ? 1 : 0];
    if ((end - at).norm() > tolerance) direction -= along * unit;
  }
  constexpr double kLeast = 1e-9;
  return direction.norm() > kLeast ? direction.normalized() : acrossCores(core, core);
}

}  // namespace

Point normalWhereCoresMeet(const ExactPart& first, const ExactPart& second, const Point& at, double tolerance) {
  if (first.radius() > 0.0 && second.radius() > 0.0) {
    const Point across = acrossCores(coreOf(first), coreOf(second));
    return across.dot(between(first, second)) < 0.0 ? Point(-across) : across;
  }
  if (first.radius() > 0.0) return -besideCore(first, at, -awayFrom(second, first, at, tolerance), tolerance);
  return besideCore(second, at, -awayFrom(first, second, at, tolerance), tolerance);
}

Point contactOfThick(const ExactPart& first, const ExactPart& second, const Nearest& cores, double tolerance) {
  if (second.radius() == 0.0) return cores.onSecond;
  if (first.radius() == 0.0 || cores.distance <= tolerance) return cores.onFirst;
  const double distance = cores.distance;
  const double squares = (second.radius() - first.radius()) * (second.radius() + first.radius());
  const double middle = (distance + squares / distance) / 2.0;
  // Capsules that cross have no such circle: what both share between the cores, or beyond them, holds the point.
  const double from = std::max(-second.radius(), distance - first.radius());
  const double to = std::min(second.radius(), distance + first.radius());
  const double way = std::min(std::max(middle, from), to);
  return cores.onSecond + (way / distance) * (cores.onFirst - cores.onSecond);
}

}  // namespace allpairs::exact
