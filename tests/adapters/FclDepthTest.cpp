// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "FclExamine.h"
#include "Shapes.h"
#include "allpairs/fcl/FclNarrowPhase.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using ::testing::AllOf;
using ::testing::Ge;
using ::testing::Le;
using ::testing::Optional;

/// Nearly the true depth, and never more.
auto isDepthOf(double depth) { return Optional(AllOf(Ge(0.99 * depth), Le((1.0 + 1e-6) * depth))); }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> trianglesOf(const TriangleModel& model) {
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : model.triangles()) {
    triangles.push_back({model.positions()[a], model.positions()[b], model.positions()[c]});
  }
  return triangles;
}

/// A convex solid lies where normal . p <= offset, for all of its faces.
struct Face {
  Vec3 normal{};
  double offset = 0.0;
};

std::vector<Face> facesOf(const TriangleModel& convex) {
  std::vector<Face> faces;
  for (const auto& [a, b, c] : trianglesOf(convex)) {
    const Vec3 normal = cross(plus(b, a, -1.0), plus(c, a, -1.0));
    const double length = std::sqrt(dot(normal, normal));
    if (length < 1e-9) continue;
    const Vec3 unit{normal[0] / length, normal[1] / length, normal[2] / length};
    faces.push_back({unit, dot(unit, a)});
  }
  return faces;
}

/// The greatest value of a concave function, by golden section.
template <class Function>
double greatest(const Function& function, double from, double to) {
  constexpr double kGolden = 0.6180339887498949;
  double left = to - kGolden * (to - from);
  double right = from + kGolden * (to - from);
  double atLeft = function(left);
  double atRight = function(right);
  double most = std::max(atLeft, atRight);
  for (int i = 0; i < 48; ++i) {
    if (atLeft < atRight) {
      from = std::exchange(left, right);
      atLeft = atRight;
      right = from + kGolden * (to - from);
      atRight = function(right);
    } else {
      to = std::exchange(right, left);
      atRight = atLeft;
      left = to - kGolden * (to - from);
      atLeft = function(left);
    }
    most = std::max({most, atLeft, atRight});
  }
  return most;
}

/// How deep the deepest point of the triangles lies in a convex solid; negative outside. In such a solid the depth of a
/// point is its distance from the nearest plane of a face: a concave function.
double deepestIn(const std::vector<Face>& solid, const std::vector<Triangle>& triangles) {
  const auto depthOf = [&](const Vec3& point) {
    double depth = std::numeric_limits<double>::infinity();
    for (const Face& face : solid) depth = std::min(depth, face.offset - dot(face.normal, point));
    return depth;
  };
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : triangles) {
    const Vec3 ab = plus(triangle[1], triangle[0], -1.0);
    const Vec3 ac = plus(triangle[2], triangle[0], -1.0);
    const auto along = [&](double u) {
      return greatest([&](double v) { return depthOf(plus(plus(triangle[0], ab, u), ac, v)); }, 0.0, 1.0 - u);
    };
    deepest = std::max(deepest, greatest(along, 0.0, 1.0));
  }
  return deepest;
}

double depthOfConvex(const TriangleModel& a, const TriangleModel& b) {
  return std::max(deepestIn(facesOf(a), trianglesOf(b)), deepestIn(facesOf(b), trianglesOf(a)));
}

/// A random way to turn and to move a model.
class Placing {
 public:
  explicit Placing(std::uint32_t seed) : m_random(seed) {}

  double between(double least, double most) { return std::uniform_real_distribution<double>(least, most)(m_random); }

  Vec3 direction() {
    std::normal_distribution<double> normal;
    const Vec3 way{normal(m_random), normal(m_random), normal(m_random)};
    const double length = std::sqrt(dot(way, way));
    return {way[0] / length, way[1] / length, way[2] / length};
  }

  /// Turned about the origin in any way.
  std::unique_ptr<TriangleModel> turned(const TriangleModel& model) {
    const Vec3 x = direction();
    Vec3 y = cross(x, direction());
    const double length = std::sqrt(dot(y, y));
    y = {y[0] / length, y[1] / length, y[2] / length};
    const Vec3 z = cross(x, y);
    std::vector<Vec3> points;
    for (const Vec3& p : model.positions()) points.push_back({dot(x, p), dot(y, p), dot(z, p)});
    return std::make_unique<TriangleModel>("turned", points, model.triangles());
  }

  std::unique_ptr<TriangleModel> turnedCuboid(double least) {
    const Vec3 half{between(least, 1.0), between(least, 1.0), between(least, 1.0)};
    return turned(*cuboid({-half[0], -half[1], -half[2]}, half));
  }

 private:
  std::mt19937 m_random;
};

std::unique_ptr<TriangleModel> moved(const TriangleModel& model, const Vec3& way) {
  std::vector<Vec3> points;
  for (const Vec3& point : model.positions()) points.push_back(plus(point, way));
  return std::make_unique<TriangleModel>("moved", points, model.triangles());
}

/// How far two models around the origin reach towards each other.
double reachAlong(const TriangleModel& first, const TriangleModel& second, const Vec3& way) {
  double most = 0.0;
  double least = 0.0;
  for (const Vec3& point : first.positions()) most = std::max(most, dot(point, way));
  for (const Vec3& point : second.positions()) least = std::min(least, dot(point, way));
  return most - least;
}

TEST(FclDepth, OfTurnedCuboidsIsThatOfTheirFaces) {
  Placing placing(31);
  int compared = 0;
  for (int i = 0; i < repeats(600); ++i) {
    // Thick and thin ones, deep in each other, or so that a little of them is shared along an axis or any direction.
    const auto first = placing.turnedCuboid(i % 2 == 0 ? 0.3 : 0.05);
    const auto still = placing.turnedCuboid(i % 4 < 2 ? 0.3 : 0.05);
    const Vec3 way = placing.direction();
    const double reach = reachAlong(*first, *still, way);
    const double share = i % 3 == 0 ? placing.between(0.0, 0.9) : placing.between(0.5, 0.99);
    const auto second = moved(*still, {share * reach * way[0], share * reach * way[1], share * reach * way[2]});
    const double depth = depthOfConvex(*first, *second);
    if (depth < 1e-3) continue;
    SCOPED_TRACE(::testing::Message() << "pair " << i);
    ++compared;
    EXPECT_THAT(examine(*first, *second).depth, isDepthOf(depth));
  }
  EXPECT_GE(compared, repeats(300));
}

TEST(FclDepth, OfBallsOfTrianglesAndCuboidsIsThatOfTheirFaces) {
  Placing placing(32);
  int compared = 0;
  for (int i = 0; i < repeats(24); ++i) {
    const auto first = placing.turned(*ball({0, 0, 0}, placing.between(0.2, 1.0), 6));
    const auto still = placing.turnedCuboid(0.2);
    const Vec3 way = placing.direction();
    const double reach = placing.between(0.0, 0.8) * reachAlong(*first, *still, way);
    const auto second = moved(*still, {reach * way[0], reach * way[1], reach * way[2]});
    const double depth = depthOfConvex(*first, *second);
    if (depth < 1e-3) continue;
    ++compared;
    SCOPED_TRACE(::testing::Message() << "pair " << i);
    EXPECT_THAT(examine(*first, *second).depth, isDepthOf(depth));
  }
  EXPECT_GE(compared, repeats(12));
}

TEST(FclDepth, OfContainedCuboidsIsThatOfTheFacesAround) {
  Placing placing(33);
  const auto outer = cuboid({-4, -5, -2}, {4, 5, 2});
  for (int i = 0; i < 24; ++i) {
    const auto inner = moved(*placing.turnedCuboid(0.1), {placing.between(-2, 2), placing.between(-2, 2), 0.2});
    const auto pair = examine(*outer, *inner);
    EXPECT_EQ(pair.state, ExactState::Contained);
    EXPECT_THAT(pair.depth, isDepthOf(depthOfConvex(*outer, *inner)));
  }
}

/// An L that is 2 long, 1 wide and 1 high.
std::unique_ptr<TriangleModel> angle() {
  const std::vector<std::array<double, 2>> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  std::vector<Vec3> points;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : outline) points.push_back({x, y, z});
  }
  std::vector<TriangleModel::Quad> quads{{0, 3, 2, 1}, {0, 5, 4, 3}, {6, 7, 8, 9}, {6, 9, 10, 11}};
  for (std::uint32_t i = 0; i < 6; ++i) quads.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
  return std::make_unique<TriangleModel>("angle", points, std::vector<TriangleModel::Triangle>{}, quads);
}

/// How far a point of the L lies below its surface; negative, or 0, outside.
double depthInAngle(const Vec3& p) {
  const double fromCorner = std::hypot(1.0 - p[0], 1.0 - p[1]);
  const double inLong = p[1] < 1.0 && p[0] >= 1.0 ? std::min(1.0 - p[1], 2.0 - p[0]) : 0.0;
  const double inHigh = p[0] < 1.0 && p[1] >= 1.0 ? std::min(1.0 - p[0], 2.0 - p[1]) : 0.0;
  const double inCorner = p[0] < 1.0 && p[1] < 1.0 ? fromCorner : 0.0;
  return std::min({p[0], p[1], p[2], 1.0 - p[2], std::max({inLong, inHigh, inCorner})});
}

TEST(FclDepth, OfAnAngleIsThatOfADenseGrid) {
  constexpr int kSteps = 300;
  Placing placing(34);
  const auto outer = angle();
  for (int i = 0; i < 16; ++i) {
    const auto still = placing.turnedCuboid(0.1);
    const auto inner = moved(*still, {placing.between(-0.3, 1.6), placing.between(-0.3, 1.6), placing.between(0, 1)});
    double depth = deepestIn(facesOf(*inner), trianglesOf(*outer));
    double widest = 0.0;
    for (const auto& [a, b, c] : trianglesOf(*inner)) {
      const Vec3 ab = plus(b, a, -1.0);
      const Vec3 ac = plus(c, a, -1.0);
      widest = std::max({widest, dot(ab, ab), dot(ac, ac)});
      for (int u = 0; u <= kSteps; ++u) {
        for (int v = 0; u + v <= kSteps; ++v) {
          depth = std::max(depth, depthInAngle(plus(plus(a, ab, double(u) / kSteps), ac, double(v) / kSteps)));
        }
      }
    }
    if (depth < 0.05) continue;
    SCOPED_TRACE(::testing::Message() << "pair " << i);
    const auto found = examine(*outer, *inner).depth;
    EXPECT_THAT(found, Optional(Ge(0.97 * depth)));
    EXPECT_THAT(found, Optional(Le(depth + std::sqrt(widest) / kSteps)));
  }
}

TEST(FclDepth, IsFromTheDeepestPointToTheSurface) {
  Placing placing(35);
  for (int i = 0; i < 50; ++i) {
    const auto first = placing.turnedCuboid(0.4);
    const auto second = moved(*placing.turnedCuboid(0.05), {0.1, 0.2, 0.3});
    const auto pair = examine(*first, *second);
    const Vec3 way = plus(pair.pointOnSecond, pair.pointOnFirst, -1.0);
    ASSERT_TRUE(pair.depth.has_value());
    EXPECT_NEAR(*pair.depth, std::sqrt(dot(way, way)), 1e-12);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(way[axis], *pair.depth * pair.normal[axis], 1e-9);
  }
}

}  // namespace
}  // namespace allpairs::test
