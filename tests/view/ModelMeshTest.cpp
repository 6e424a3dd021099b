// SPDX-License-Identifier: MIT
// The shapes that pages and pictures are given: of meshes the meshes themselves, of solids closed surfaces around them.
#include "ModelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "VectorMath.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/OrientedBoxModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "allpairs/collision/TriangleModel.h"

namespace allpairs::test {
namespace {

using namespace collision;
using view::ViewMesh;
using Indices = std::vector<std::uint32_t>;

Vec3 meshVertex(const ViewMesh& mesh, std::uint32_t i) {
  return {mesh.vertices.at(3 * std::size_t{i}), mesh.vertices.at(3 * std::size_t{i} + 1),
          mesh.vertices.at(3 * std::size_t{i} + 2)};
}

/// What the triangles enclose, above 0 where they are seen counterclockwise from outside.
double volumeOf(const ViewMesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const Vec3 a = meshVertex(mesh, mesh.triangles[i]);
    sum += view::dot(a, view::cross(meshVertex(mesh, mesh.triangles[i + 1]), meshVertex(mesh, mesh.triangles[i + 2])));
  }
  return sum / 6.0;
}

/// Whether each edge of a triangle is that of one other, which goes along it the other way.
bool isClosed(const ViewMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    if (!edges.emplace(mesh.triangles[i], mesh.triangles[next]).second) return false;
  }
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](auto edge) {
    return edges.contains({edge.second, edge.first});
  });
}

double distanceToSegment(const Vec3& p, const Vec3& begin, const Vec3& end) {
  const Vec3 along = view::minus(end, begin);
  const double square = view::dot(along, along);
  const double t = square > 0.0 ? std::clamp(view::dot(view::minus(p, begin), along) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - begin[0] - t * along[0], p[1] - begin[1] - t * along[1], p[2] - begin[2] - t * along[2]);
}

/// Whether it is closed around a segment: all vertices as far as the radius, and little of the volume missing.
void expectRound(const ViewMesh& mesh, const Capsule& capsule) {
  constexpr double kMost = 1e-12;
  EXPECT_TRUE(isClosed(mesh));
  for (std::uint32_t i = 0; i < mesh.vertices.size() / 3; ++i) {
    const double distance = distanceToSegment(meshVertex(mesh, i), capsule.begin, capsule.end);
    EXPECT_NEAR(distance, capsule.radius, kMost) << i;
  }
  const Vec3 along = view::minus(capsule.end, capsule.begin);
  const double length = std::sqrt(view::dot(along, along));
  const double disc = std::numbers::pi * capsule.radius * capsule.radius;
  const double share = volumeOf(mesh) / (disc * (length + 4.0 / 3.0 * capsule.radius));
  EXPECT_GT(share, 0.91);
  EXPECT_LT(share, 1.0);
}

TEST(ModelMesh, MeshesAreAsTheyAreOneAfterTheOther) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 2, 0}, {0, 3, 4}, {5, 0, 6}};
  ViewMesh mesh;
  addModel(mesh, TriangleModel("a", points, {{0, 1, 2}, {3, 2, 1}}));
  addModel(mesh, LineModel("b", points, {{0, 3}, {2, 1}}));
  addModel(mesh, PointModel("c", {{7, 8, 9}, {1, 1, 1}}));
  addModel(mesh, TetrahedronModel("d", points, {{0, 1, 2, 3}}));
  std::vector<double> vertices;
  for (const auto& part : {points, points, std::vector<Vec3>{{7, 8, 9}, {1, 1, 1}}, points}) {
    for (const Vec3& p : part) vertices.insert(vertices.end(), p.begin(), p.end());
  }
  EXPECT_EQ(mesh.vertices, vertices);
  EXPECT_EQ(mesh.triangles, (Indices{0, 1, 2, 3, 2, 1, 10, 12, 11, 10, 11, 13, 11, 12, 13, 12, 10, 13}));
  EXPECT_EQ(mesh.lines, (Indices{4, 7, 6, 5}));
  EXPECT_EQ(mesh.points, (Indices{8, 9}));
  EXPECT_EQ(mesh.triangleEnds, (Indices{6, 6, 6, 18}));
  EXPECT_EQ(mesh.lineEnds, (Indices{0, 4, 4, 4}));
  EXPECT_EQ(mesh.pointEnds, (Indices{0, 0, 2, 2}));
  EXPECT_FALSE(mesh.isShortened);
}

TEST(ModelMesh, ATurnedBoxHasItsCornersAndItsVolume) {
  const OrientedBox box = OrientedBox::turned({1, 2, 3}, {0.5, 0.5, 0.1, 0.7}, {0.5, 1.0, 2.0});
  ViewMesh mesh;
  addModel(mesh, OrientedBoxModel("b", {box}));
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_NEAR(volumeOf(mesh), 8.0, 1e-12);
  std::set<std::array<int, 3>> corners;
  for (std::uint32_t i = 0; i < mesh.vertices.size() / 3; ++i) {
    const Vec3 from = view::minus(meshVertex(mesh, i), box.centre);
    std::array<int, 3> sides{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = view::dot(from, box.axes[axis]) / box.halfExtents[axis];
      EXPECT_NEAR(std::abs(along), 1.0, 1e-12) << i;
      sides[axis] = along > 0.0 ? 1 : -1;
    }
    corners.insert(sides);
  }
  EXPECT_EQ(corners.size(), 8U);
}

TEST(ModelMesh, BallsAreRoundAndCapsulesAroundTheirSegments) {
  ViewMesh ball;
  addModel(ball, SphereModel("s", {{1, 2, 3}}, {2.0}));
  expectRound(ball, {{1, 2, 3}, {1, 2, 3}, 2.0});
  for (const Vec3& end : {Vec3{1, 2, 9}, Vec3{1, 2, -4}, Vec3{4, 3, 3}, Vec3{2, 2.5, 5}, Vec3{1, 2, 3}}) {
    ViewMesh mesh;
    addModel(mesh, CapsuleModel("c", {{{1, 2, 3}, end, 0.5}}));
    expectRound(mesh, {{1, 2, 3}, end, 0.5});
  }
}

TEST(ModelMesh, WhatWouldBeTooMuchIsLeftOut) {
  constexpr std::size_t kMost = 12'000'000;
  constexpr std::size_t kOfBall = 16 * 8 * 6;
  ViewMesh mesh;
  mesh.lines.resize(24);
  const auto endsOf = [&] {
    return std::array{mesh.triangles.size() - mesh.triangleEnds.back(), mesh.lines.size() - mesh.lineEnds.back(),
                      mesh.points.size() - mesh.pointEnds.back()};
  };
  mesh.triangles.resize(kMost - 24 - 12);
  addModel(mesh, PointModel("fits", {{0, 0, 0}}));
  EXPECT_FALSE(mesh.isShortened);
  EXPECT_EQ(mesh.points.size(), 1U);
  addModel(mesh, PointModel("too much", {{0, 0, 0}, {1, 1, 1}}));
  EXPECT_TRUE(mesh.isShortened);
  EXPECT_EQ(mesh.points.size(), 1U);
  EXPECT_EQ(mesh.triangleEnds.size(), 2U) << "it has no shape, but a place";
  EXPECT_EQ(endsOf(), (std::array<std::size_t, 3>{}));
  mesh.isShortened = false;
  mesh.triangles.resize(kMost - 24 - kOfBall + 1);
  addModel(mesh, SphereModel("too much", {{0, 0, 0}}, {1.0}));
  EXPECT_TRUE(mesh.isShortened);
  mesh.isShortened = false;
  mesh.triangles.resize(kMost - 24 - kOfBall);
  addModel(mesh, SphereModel("fits", {{0, 0, 0}}, {1.0}));
  EXPECT_FALSE(mesh.isShortened);
  EXPECT_GT(mesh.triangles.size(), kMost - 24 - kOfBall);
  EXPECT_EQ(endsOf(), (std::array<std::size_t, 3>{}));
}

}  // namespace
}  // namespace allpairs::test
