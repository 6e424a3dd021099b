// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "allpairs/collision/TriangleModel.h"

namespace allpairs::test {

using collision::TriangleModel;
using collision::Vec3;

/// The surface of a cuboid from one corner to the other; inside out if `isTurned`.
inline std::unique_ptr<TriangleModel> cuboid(const Vec3& min, const Vec3& max, bool isTurned = false) {
  std::vector<Vec3> corners;
  for (const double z : {min[2], max[2]}) {
    for (const double y : {min[1], max[1]}) {
      for (const double x : {min[0], max[0]}) corners.push_back({x, y, z});
    }
  }
  std::vector<TriangleModel::Quad> sides{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (auto& side : sides) {
    if (isTurned) std::swap(side[1], side[3]);
  }
  return std::make_unique<TriangleModel>("cuboid", corners, std::vector<TriangleModel::Triangle>{}, sides);
}

inline std::unique_ptr<TriangleModel> unitCube(const Vec3& at) {
  return cuboid(at, {at[0] + 1.0, at[1] + 1.0, at[2] + 1.0});
}

/// A unit cube of which each face is cut into n times n squares.
inline std::unique_ptr<TriangleModel> fineCube(const Vec3& at, std::uint32_t n) {
  std::vector<Vec3> points;
  std::vector<TriangleModel::Quad> quads;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {0.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(points.size());
      for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) {
          points.push_back(at);
          points.back()[axis] += side;
          points.back()[(axis + 1) % 3] += double(i) / n;
          points.back()[(axis + 2) % 3] += double(j) / n;
        }
      }
      for (std::uint32_t i = first; i < first + n * (n + 1); ++i) {
        if ((i - first) % (n + 1) == n) continue;
        const TriangleModel::Quad outward{i, i + n + 1, i + n + 2, i + 1};
        quads.push_back(side > 0.0 ? outward : TriangleModel::Quad{outward[3], outward[2], outward[1], outward[0]});
      }
    }
  }
  return std::make_unique<TriangleModel>("fine cube", points, std::vector<TriangleModel::Triangle>{}, quads);
}

/// A cube of side 4 around the origin without its last triangle.
inline std::unique_ptr<TriangleModel> openCube() {
  const auto whole = cuboid({-2, -2, -2}, {2, 2, 2});
  auto triangles = whole->triangles();
  triangles.pop_back();
  return std::make_unique<TriangleModel>("open", whole->positions(), triangles);
}

/// The triangles of several models as one model.
inline std::unique_ptr<TriangleModel> together(const std::vector<const TriangleModel*>& models) {
  std::vector<Vec3> points;
  std::vector<TriangleModel::Triangle> triangles;
  for (const TriangleModel* model : models) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), model->positions().begin(), model->positions().end());
    for (const auto& [a, b, c] : model->triangles()) triangles.push_back({first + a, first + b, first + c});
  }
  return std::make_unique<TriangleModel>("together", points, triangles);
}

/// A closed ball of many triangles whose corners lie on the sphere.
inline std::unique_ptr<TriangleModel> ball(const Vec3& centre, double radius, std::uint32_t rings = 24) {
  const std::uint32_t columns = 2 * rings;
  std::vector<Vec3> points;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    const double height = std::numbers::pi * ring / rings;
    for (std::uint32_t column = 0; column < columns; ++column) {
      const bool isPole = ring == 0 || ring == rings;
      const double turn = isPole ? 0.0 : 2.0 * std::numbers::pi * column / columns;
      const double r = isPole ? 0.0 : radius * std::sin(height);
      const double z = ring == 0 ? radius : (ring == rings ? -radius : radius * std::cos(height));
      points.push_back({centre[0] + r * std::cos(turn), centre[1] + r * std::sin(turn), centre[2] + z});
    }
  }
  std::vector<TriangleModel::Quad> quads;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t next = (column + 1) % columns;
      quads.push_back(
          {ring * columns + column, (ring + 1) * columns + column, (ring + 1) * columns + next, ring * columns + next});
    }
  }
  return std::make_unique<TriangleModel>("ball", points, std::vector<TriangleModel::Triangle>{}, quads);
}

/// A model turned about the z axis, then about the x axis, and `scale` times as large.
inline std::unique_ptr<TriangleModel> turned(const TriangleModel& model, double angle, double scale = 1.0) {
  std::vector<Vec3> points = model.positions();
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (Vec3& p : points) {
    p = {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
    p = {scale * p[0], scale * (c * p[1] - s * p[2]), scale * (s * p[1] + c * p[2])};
  }
  return std::make_unique<TriangleModel>("turned", points, model.triangles());
}

}  // namespace allpairs::test
