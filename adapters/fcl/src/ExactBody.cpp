// SPDX-License-Identifier: MIT
#include "ExactBody.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/OrientedBoxModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "allpairs/collision/TriangleModel.h"

namespace allpairs::exact {
namespace {

using collision::CollisionModel;

/// Products of four lengths, and their quotients, stay within the numbers.
constexpr double kLargest = 1e70;
constexpr double kSmallest = 1e-60;

void addPart(ExactBody& body, std::vector<Corners> triangles, double radius = 0.0) {
  for (const Corners& corners : triangles) {
    for (const Point& corner : corners) body.isKnown = body.isKnown && corner.cwiseAbs().maxCoeff() <= kLargest;
  }
  body.isKnown = body.isKnown && radius <= kLargest;
  if (body.isKnown && !triangles.empty())
    body.parts.push_back(std::make_unique<ExactPart>(std::move(triangles), radius));
}

Point pointOf(const collision::MeshModel& mesh, std::uint32_t vertex) { return toPoint(mesh.positions()[vertex]); }

void add(ExactBody& body, const collision::TriangleModel& model) {
  std::vector<Corners> triangles;
  triangles.reserve(model.triangles().size());
  for (const auto& [a, b, c] : model.triangles()) {
    triangles.push_back({pointOf(model, a), pointOf(model, b), pointOf(model, c)});
  }
  addPart(body, std::move(triangles));
}

void add(ExactBody& body, const collision::LineModel& model) {
  std::vector<Corners> segments;
  for (const auto& [a, b] : model.lines()) {
    segments.push_back({pointOf(model, a), pointOf(model, b), pointOf(model, b)});
  }
  addPart(body, std::move(segments));
}

void add(ExactBody& body, const collision::PointModel& model) {
  std::vector<Corners> points;
  for (const auto& position : model.positions()) {
    const Point point = toPoint(position);
    points.push_back({point, point, point});
  }
  addPart(body, std::move(points));
}

/// The corner of a tetrahedron's faces, seen from outside in order if its volume is positive.
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

double signedVolume(const collision::TetrahedronModel& model, const collision::TetrahedronModel::Tetrahedron& t) {
  const Point origin = pointOf(model, t[0]);
  const Point ab = pointOf(model, t[1]) - origin;
  return ab.cross(pointOf(model, t[2]) - origin).dot(pointOf(model, t[3]) - origin);
}

/// The faces that only one tetrahedron has, where each is taken once.
void add(ExactBody& body, const collision::TetrahedronModel& model) {
  std::map<std::array<std::uint32_t, 3>, std::vector<std::array<std::uint32_t, 3>>> faces;
  std::set<collision::TetrahedronModel::Tetrahedron> taken;
  for (const auto& t : model.tetrahedra()) {
    collision::TetrahedronModel::Tetrahedron vertices = t;
    std::sort(vertices.begin(), vertices.end());
    if (!taken.insert(vertices).second) continue;
    const bool isTurned = signedVolume(model, t) < 0.0;
    for (const auto& [a, b, c] : kFaces) {
      std::array<std::uint32_t, 3> face{t[a], t[isTurned ? c : b], t[isTurned ? b : c]};
      std::array<std::uint32_t, 3> key = face;
      std::sort(key.begin(), key.end());
      faces[key].push_back(face);
    }
  }
  std::vector<Corners> triangles;
  for (const auto& [key, sides] : faces) {
    if (sides.size() != 1) continue;
    const auto& [a, b, c] = sides.front();
    triangles.push_back({pointOf(model, a), pointOf(model, b), pointOf(model, c)});
  }
  addPart(body, std::move(triangles));
}

/// The 12 triangles of a box, from its corners: bit 0 of an index is x, bit 1 is y, bit 2 is z.
std::vector<Corners> boxTriangles(const std::array<Point, 8>& corners) {
  constexpr std::array<std::array<std::size_t, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  std::vector<Corners> triangles;
  for (const auto& [a, b, c, d] : kSides) {
    triangles.push_back({corners[a], corners[b], corners[c]});
    triangles.push_back({corners[a], corners[c], corners[d]});
  }
  return triangles;
}

bool isFinite(const Box& box) {
  return std::all_of(box.min.begin(), box.min.end(), [](double x) { return std::isfinite(x); }) &&
         std::all_of(box.max.begin(), box.max.end(), [](double x) { return std::isfinite(x); });
}

void add(ExactBody& body, const collision::BoxModel& model) {
  for (const Box& box : model.boxes()) {
    if (isEmpty(box)) continue;
    if (!isFinite(box)) body.isKnown = false;  // no triangle reaches so far
    if (!body.isKnown) return;
    std::array<Point, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners[i][static_cast<int>(axis)] = ((i >> axis) & 1U) != 0 ? box.max[axis] : box.min[axis];
      }
    }
    addPart(body, boxTriangles(corners));
  }
}

void add(ExactBody& body, const collision::OrientedBoxModel& model) {
  for (const collision::OrientedBox& box : model.boxes()) {
    std::array<Point, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      corners[i] = toPoint(box.centre);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double side = ((i >> axis) & 1U) != 0 ? 1.0 : -1.0;
        corners[i] += side * box.halfExtents[axis] * toPoint(box.axes[axis]);
      }
    }
    addPart(body, boxTriangles(corners));
  }
}

void add(ExactBody& body, const collision::SphereModel& model) {
  for (std::size_t i = 0; i < model.getSize(); ++i) {
    const Point centre = toPoint(model.centres()[i]);
    addPart(body, {{centre, centre, centre}}, model.radii()[i]);
  }
}

void add(ExactBody& body, const collision::CapsuleModel& model) {
  for (const collision::Capsule& capsule : model.capsules()) {
    const Point end = toPoint(capsule.end);
    addPart(body, {{toPoint(capsule.begin), end, end}}, capsule.radius);
  }
}

template <class Model>
bool addIf(ExactBody& body, const CollisionModel& model) {
  const auto* known = dynamic_cast<const Model*>(&model);
  if (known != nullptr) add(body, *known);
  return known != nullptr;
}

template <class... Models>
bool addAnyOf(ExactBody& body, const CollisionModel& model) {
  return (addIf<Models>(body, model) || ...);
}

Box thickened(const ExactPart& part) {
  Box box = part.box();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] -= part.radius();
    box.max[axis] += part.radius();
  }
  return box;
}

/// Finds how far the parts reach.
void measure(ExactBody& body) {
  double radius = 0.0;
  body.boxes.reserve(body.parts.size());
  for (const auto& part : body.parts) {
    body.box = merge(body.box, part->box());
    body.boxes.push_back(thickened(*part));
    radius = std::max(radius, part->radius());
  }
  if (body.parts.empty()) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    body.extent = std::max(body.extent, body.box.max[axis] - body.box.min[axis]);
    body.reach = std::max({body.reach, std::abs(body.box.min[axis]), std::abs(body.box.max[axis])});
  }
  body.extent += 2.0 * radius;
}

}  // namespace

ExactBody makeBody(const CollisionModel& model) {
  using namespace collision;
  ExactBody body;
  const bool isKnown = addAnyOf<TriangleModel, LineModel, PointModel, TetrahedronModel, BoxModel, OrientedBoxModel,
                                SphereModel, CapsuleModel>(body, *model.getLast());
  measure(body);
  body.isKnown = body.isKnown && isKnown && (body.extent == 0.0 || body.extent >= kSmallest);
  return body;
}

}  // namespace allpairs::exact
