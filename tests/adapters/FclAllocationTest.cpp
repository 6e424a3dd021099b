// SPDX-License-Identifier: MIT
// What a narrow phase asks for does not grow with the pairs of parts that are apart, or with those of points and
// triangles, that it has to think of.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "FclExamine.h"
#include "Shapes.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/SphereModel.h"
#include "support/AllocationCount.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

/// What a look at two models asks for.
std::size_t bytesOf(collision::CollisionModel& first, collision::CollisionModel& second) {
  const std::size_t before = allocatedBytes();
  static_cast<void>(examine(first, second));
  return allocatedBytes() - before;
}

/// Balls in the places of a square lattice.
std::unique_ptr<collision::SphereModel> lattice(std::size_t side, const Vec3& at) {
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i < side * side; ++i) {
    centres.push_back({at[0] + 10.0 * double(i % side), at[1] + 10.0 * double(i / side), at[2]});
  }
  return std::make_unique<collision::SphereModel>("lattice", centres, std::vector<double>(), 1.0);
}

/// Thin capsules above each other, each along the diagonal: from another such bundle they are further apart than their
/// boxes.
std::unique_ptr<collision::CapsuleModel> bundle(std::size_t count, double x) {
  std::vector<collision::Capsule> capsules;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 0.01 * double(i);
    capsules.push_back({{x, 0.0, z}, {x + 100.0, 100.0, z}, 0.001});
  }
  return std::make_unique<collision::CapsuleModel>("bundle", capsules);
}

/// A thin rod through the origin along the diagonal, or the one mirrored in z, of so many sides, each as long as it is.
std::unique_ptr<TriangleModel> rod(std::uint32_t sides, double way) {
  const double root = std::numbers::sqrt2 / 2.0;
  std::vector<Vec3> points;
  for (const double end : {-50.0, 50.0}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / sides;
      const double u = std::cos(turn);
      const double v = std::sin(turn);
      points.push_back({end + root * u, end - root * u + v, way * (end - v)});
    }
  }
  std::vector<TriangleModel::Quad> quads;
  std::vector<TriangleModel::Triangle> triangles;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    quads.push_back({i, next, sides + next, sides + i});
    if (i == 0 || next == 0) continue;
    triangles.push_back({0, next, i});
    triangles.push_back({sides, sides + i, sides + next});
  }
  return std::make_unique<TriangleModel>("rod", points, triangles, quads);
}

TEST(FclAllocation, OfModelsOfManyPartsIsNoListOfAllPairs) {
  const auto first = lattice(40, {0, 0, 0});
  const auto apart = lattice(40, {4, 0, 0});
  const auto above = lattice(40, {0, 0, 500});
  EXPECT_EQ(examine(*first, *apart).distance, 2.0);
  EXPECT_EQ(examine(*first, *above).distance, 498.0);
  EXPECT_LT(bytesOf(*first, *apart), 20 * kMegabyte);
  EXPECT_LT(bytesOf(*first, *above), 20 * kMegabyte);
}

TEST(FclAllocation, OfPartsThatAreFurtherApartThanTheirBoxesIsOneLookAtEachTwo) {
  constexpr std::size_t kCount = kIsSanitized ? 350 : 700;
  constexpr std::size_t kMostOfALook = 64;
  const auto first = bundle(kCount, 0.0);
  const auto second = bundle(kCount, 101.0);
  EXPECT_LT(bytesOf(*first, *second), kCount * kCount * kMostOfALook);
}

TEST(FclAllocation, OfLongTrianglesIsNoListOfAllWithAllPointsOfTheOther) {
  const auto first = rod(200, 1.0);
  const auto second = rod(200, -1.0);
  EXPECT_EQ(examine(*first, *second).state, ExactState::Clash);
  EXPECT_LT(bytesOf(*first, *second), 30 * kMegabyte);
}

}  // namespace
}  // namespace allpairs::test
