// SPDX-License-Identifier: MIT
#include "ModelMesh.h"

#include <array>
#include <cmath>
#include <numbers>

#include "VectorMath.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/OrientedBoxModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "allpairs/collision/TriangleModel.h"

namespace allpairs::view {
namespace {

constexpr std::size_t kMostIndices = 12'000'000;  // four million triangles: what a laptop still turns smoothly

Vec3 plus(const Vec3& a, const Vec3& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Vec3 normalized(const Vec3& a, const Vec3& otherwise) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return length > 0.0 ? Vec3{a[0] / length, a[1] / length, a[2] / length} : otherwise;
}

/// Appends vertices and indices that count from the first of its vertices.
class Shape {
 public:
  explicit Shape(ViewMesh& mesh) : m_mesh(mesh), m_base(static_cast<std::uint32_t>(mesh.vertices.size() / 3)) {}

  void vertex(const Vec3& p) { m_mesh.vertices.insert(m_mesh.vertices.end(), p.begin(), p.end()); }

  void vertices(const std::vector<Vec3>& points) {
    for (const Vec3& p : points) vertex(p);
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    m_mesh.triangles.insert(m_mesh.triangles.end(), {m_base + a, m_base + b, m_base + c});
  }

  void line(std::uint32_t a, std::uint32_t b) { m_mesh.lines.insert(m_mesh.lines.end(), {m_base + a, m_base + b}); }
  void point(std::uint32_t a) { m_mesh.points.push_back(m_base + a); }

 private:
  ViewMesh& m_mesh;
  std::uint32_t m_base;
};

/// Rows of rings between two poles along an axis, joined by triangles: a sphere, and with ends apart a capsule.
class RoundShape {
 public:
  static constexpr std::uint32_t kAround = 16;
  static constexpr std::uint32_t kRings = 8;  // even: half of them belong to each end

  RoundShape(const Vec3& begin, const Vec3& end, double radius) : m_begin(begin), m_end(end), m_radius(radius) {
    m_axis = normalized(plus(end, begin, -1.0), {0.0, 0.0, 1.0});
    const bool isUpright = std::abs(m_axis[2]) > 0.9;
    m_u = normalized(cross(m_axis, isUpright ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 0.0, 1.0}), {1.0, 0.0, 0.0});
    m_v = cross(m_axis, m_u);
  }

  void addTo(ViewMesh& mesh) const {
    Shape shape(mesh);
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
      for (std::uint32_t step = 0; step < kAround; ++step) shape.vertex(pointAt(ring, step));
    }
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) addBand(shape, ring);
    for (std::uint32_t step = 2; step < kAround; ++step) {
      const std::uint32_t top = (kRings - 1) * kAround;
      shape.triangle(0, step, step - 1);
      shape.triangle(top, top + step - 1, top + step);
    }
  }

 private:
  [[nodiscard]] Vec3 pointAt(std::uint32_t ring, std::uint32_t step) const {
    const bool isFirst = ring < kRings / 2;
    const double t = static_cast<double>(isFirst ? ring : ring - 1) / (kRings - 2);  // both ends have an equator
    const double latitude = (t - 0.5) * std::numbers::pi * 0.96;                     // caps instead of poles
    const double longitude = 2.0 * std::numbers::pi * step / kAround;
    const double around = m_radius * std::cos(latitude);
    Vec3 p = plus(isFirst ? m_begin : m_end, m_axis, m_radius * std::sin(latitude));
    p = plus(p, m_u, around * std::cos(longitude));
    return plus(p, m_v, around * std::sin(longitude));
  }

  static void addBand(Shape& shape, std::uint32_t ring) {
    for (std::uint32_t step = 0; step < kAround; ++step) {
      const std::uint32_t a = ring * kAround + step;
      const std::uint32_t b = ring * kAround + (step + 1) % kAround;
      shape.triangle(a, b, b + kAround);
      shape.triangle(a, b + kAround, a + kAround);
    }
  }

  Vec3 m_begin;
  Vec3 m_end;
  double m_radius;
  Vec3 m_axis{};
  Vec3 m_u{};
  Vec3 m_v{};
};

void add(const collision::TriangleModel& model, Shape& shape) {
  shape.vertices(model.positions());
  for (const auto& [a, b, c] : model.triangles()) shape.triangle(a, b, c);
}

void add(const collision::TetrahedronModel& model, Shape& shape) {
  shape.vertices(model.positions());
  for (const auto& [a, b, c, d] : model.tetrahedra()) {
    shape.triangle(a, c, b);
    shape.triangle(a, b, d);
    shape.triangle(b, c, d);
    shape.triangle(c, a, d);
  }
}

void add(const collision::LineModel& model, Shape& shape) {
  shape.vertices(model.positions());
  for (const auto& [a, b] : model.lines()) shape.line(a, b);
}

void add(const collision::PointModel& model, Shape& shape) {
  shape.vertices(model.positions());
  for (std::uint32_t i = 0; i < model.positions().size(); ++i) shape.point(i);
}

void add(const collision::OrientedBox& box, ViewMesh& mesh) {
  static constexpr std::array<std::array<std::uint32_t, 3>, 12> kFaces{{{0, 2, 3},
                                                                        {0, 3, 1},
                                                                        {4, 5, 7},
                                                                        {4, 7, 6},
                                                                        {0, 1, 5},
                                                                        {0, 5, 4},
                                                                        {2, 6, 7},
                                                                        {2, 7, 3},
                                                                        {0, 4, 6},
                                                                        {0, 6, 2},
                                                                        {1, 3, 7},
                                                                        {1, 7, 5}}};
  Shape shape(mesh);
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 p = box.centre;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double sign = (corner >> axis & 1U) != 0 ? 1.0 : -1.0;
      p = plus(p, box.axes[axis], sign * box.halfExtents[axis]);
    }
    shape.vertex(p);
  }
  for (const auto& [a, b, c] : kFaces) shape.triangle(a, b, c);
}

/// Adds a model of type Model, if it is one.
template <class Model, class Add>
bool addIf(const collision::CollisionModel& model, const Add& adder) {
  const auto* typed = dynamic_cast<const Model*>(&model);
  if (typed != nullptr) adder(*typed);
  return typed != nullptr;
}

template <class Model>
bool addMeshIf(const collision::CollisionModel& model, ViewMesh& mesh) {
  return addIf<Model>(model, [&mesh](const Model& typed) {
    Shape shape(mesh);
    add(typed, shape);
  });
}

bool addMesh(const collision::CollisionModel& model, ViewMesh& mesh) {
  return addMeshIf<collision::TriangleModel>(model, mesh) || addMeshIf<collision::TetrahedronModel>(model, mesh) ||
         addMeshIf<collision::LineModel>(model, mesh) || addMeshIf<collision::PointModel>(model, mesh);
}

void addSolids(const collision::CollisionModel& model, ViewMesh& mesh) {
  addIf<collision::OrientedBoxModel>(model, [&](const auto& boxes) {
    for (const auto& box : boxes.boxes()) add(box, mesh);
  });
  addIf<collision::SphereModel>(model, [&](const auto& spheres) {
    for (std::size_t i = 0; i < spheres.getSize(); ++i) {
      RoundShape(spheres.centres()[i], spheres.centres()[i], spheres.radii()[i]).addTo(mesh);
    }
  });
  addIf<collision::CapsuleModel>(model, [&](const auto& capsules) {
    for (const auto& capsule : capsules.capsules()) RoundShape(capsule.begin, capsule.end, capsule.radius).addTo(mesh);
  });
}

/// About how many indices the shape takes: spheres have the most for one element.
std::size_t weightOf(const collision::CollisionModel& model) {
  const bool isRound = model.typeName() == "TSphereModel" || model.typeName() == "TCapsuleModel";
  return model.getSize() * (isRound ? std::size_t{RoundShape::kAround} * RoundShape::kRings * 6 : 12);
}

}  // namespace

void addModel(ViewMesh& mesh, const collision::CollisionModel& model) {
  const collision::CollisionModel& elements = *model.getLast();
  if (mesh.triangles.size() + mesh.lines.size() + weightOf(elements) > kMostIndices) {
    mesh.isShortened = true;
  } else if (!addMesh(elements, mesh)) {
    addSolids(elements, mesh);
  }
  mesh.triangleEnds.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
  mesh.lineEnds.push_back(static_cast<std::uint32_t>(mesh.lines.size()));
  mesh.pointEnds.push_back(static_cast<std::uint32_t>(mesh.points.size()));
}

}  // namespace allpairs::view
