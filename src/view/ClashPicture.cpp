// SPDX-License-Identifier: MIT
#include "ClashPicture.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "MeshPart.h"
#include "VectorMath.h"

namespace allpairs::view {
namespace {

/// In pixels; twice as many are drawn.
struct Size {
  std::size_t width;
  std::size_t height;
};

constexpr Size kPicture{640, 480};
constexpr Size kOverview{152, 114};
constexpr Colour kBackground{246, 248, 250};
constexpr Colour kPaper{255, 255, 255};
constexpr Colour kGrey{176, 184, 192};
constexpr Colour kFrame{120, 130, 140};
constexpr Colour kFirst{0, 114, 178};  // colours that people with any colour vision tell apart
constexpr Colour kSecond{230, 159, 0};
constexpr Colour kShared{213, 50, 15};
constexpr Colour kHalo{255, 244, 238};
constexpr double kInFront = 1e4;  // heights of the picture: nearer than anything in it

/// Corner 0 to 7: bit k says whether it is at the maximum of axis k.
Vec3 cornerOf(const Box& box, unsigned corner) {
  Vec3 p = box.min;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if ((corner >> axis & 1U) != 0) p[axis] = box.max[axis];
  }
  return p;
}

/// Infinite sides end where the picture has long ended.
Box finite(const Box& box, const ParallelCamera& camera) {
  constexpr double kFar = 50.0;
  Box result = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = std::max(box.min[axis], camera.centre[axis] - kFar * camera.height);
    result.max[axis] = std::min(box.max[axis], camera.centre[axis] + kFar * camera.height);
  }
  return result;
}

class Drawing {
 public:
  Drawing(const ViewScene& scene, const ParallelCamera& camera, Raster& canvas)
      : m_scene(scene), m_camera(camera), m_raster(canvas), m_projection(camera, canvas) {
    for (std::size_t i = 0; i < 3; ++i)
      m_light[i] = 0.30 * m_projection.right()[i] + 0.50 * camera.up[i] - 0.81 * camera.direction[i];
  }

  /// A model by its shape alone, if it has one.
  void shape(std::uint32_t model, Colour colour) {
    drawTriangles(model, colour);
    drawLines(model, colour);
    if (!hasShape(model)) this->model(model, colour);
  }

  /// A model through which one sees what lies in it.
  void ghost(std::uint32_t model, Colour colour) {
    const ProjectedTriangles triangles(m_scene.mesh, model, m_projection);
    for (std::size_t i = 0; i + 2 < triangles.indices.size(); i += 3) m_raster.veil(triangles.at(i), colour, 0.14);
    if (triangles.indices.empty()) this->model(model, colour);
  }

  /// The contact, in front of everything: where surfaces cross, and how deep one reaches into the other.
  void contact(const ExactPair& pair) {
    for (const double width : {9.0, 5.0}) {  // light around it, so that it is seen on any colour
      const Colour colour = width > 5.0 ? kHalo : kShared;
      for (const auto& [from, to] : pair.contactLines) inFront(from, to, colour, width);
      const bool hasDepth = pair.depth.value_or(0.0) > 0.0 || !isContact(pair.state);
      if (hasDepth) inFront(pair.pointOnFirst, pair.pointOnSecond, colour, width);
      if (!hasDepth && pair.contactLines.empty() && pair.state != ExactState::Duplicate) {
        for (const Vec3& point : pair.contactPoints) inFront(point, point, colour, width + 6.0);
      }
    }
    for (const Vec3& end : {pair.pointOnFirst, pair.pointOnSecond}) {
      if (pair.depth.value_or(0.0) > 0.0 || !isContact(pair.state)) inFront(end, end, kShared, 11.0);
    }
  }

  void model(std::uint32_t model, Colour colour) {
    drawTriangles(model, colour);
    drawLines(model, colour);
    const Box box = finite(m_scene.frames.front().boxes[model], m_camera);
    if (!hasShape(model)) this->veil(box, colour, 0.25);
    edges(box, colour, 2.5);
  }

  /// In front of everything: where one model is inside of the other, nothing else of it would be seen.
  void shared(const Box& box) {
    const Box cut = finite(box, m_camera);
    veil(cut, kShared, 0.5);
    edges(cut, kShared, 3.5, kInFront);
  }

 private:
  [[nodiscard]] RasterPoint project(const Vec3& p) const { return m_projection(p); }

  [[nodiscard]] Vec3 vertex(std::uint32_t i) const { return vertexOf(m_scene.mesh, i); }

  [[nodiscard]] bool hasShape(std::uint32_t model) const {
    const ViewMesh& mesh = m_scene.mesh;
    return !partOf(mesh.triangles, mesh.triangleEnds, model).empty() ||
           !partOf(mesh.lines, mesh.lineEnds, model).empty() || !partOf(mesh.points, mesh.pointEnds, model).empty();
  }

  void drawTriangles(std::uint32_t model, Colour colour) {
    const ProjectedTriangles triangles(m_scene.mesh, model, m_projection);
    const auto indices = triangles.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const std::array<Vec3, 3> corners{vertex(indices[i]), vertex(indices[i + 1]), vertex(indices[i + 2])};
      m_raster.triangle(triangles.at(i), lit(corners, colour));
    }
  }

  void drawLines(std::uint32_t model, Colour colour) {
    const auto indices = partOf(m_scene.mesh.lines, m_scene.mesh.lineEnds, model);
    for (std::size_t i = 0; i + 1 < indices.size(); i += 2) {
      m_raster.line(project(vertex(indices[i])), project(vertex(indices[i + 1])), colour, 2.0);
    }
    for (const std::uint32_t point : partOf(m_scene.mesh.points, m_scene.mesh.pointEnds, model)) {
      m_raster.line(project(vertex(point)), project(vertex(point)), colour, 8.0);
    }
  }

  /// A colour in the light that falls on a triangle from behind the camera's shoulder.
  [[nodiscard]] Colour lit(const std::array<Vec3, 3>& corners, Colour colour) const {
    const Vec3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const double length = std::sqrt(dot(normal, normal));
    const double brightness = 0.45 + 0.55 * (length > 0.0 ? std::abs(dot(normal, m_light)) / length : 1.0);
    for (std::uint8_t& part : colour) part = shade(part * brightness);
    return colour;
  }

  void inFront(const Vec3& from, const Vec3& to, Colour colour, double width) {
    RasterPoint begin = project(from);
    RasterPoint end = project(to);
    begin.depth -= kInFront;
    end.depth -= kInFront;
    m_raster.line(begin, end, colour, width);
  }

  void veil(const Box& box, Colour colour, double opacity) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned side = m_camera.direction[axis] < 0.0 ? 1U << axis : 0U;  // the face that the camera sees
      const unsigned u = 1U << (axis + 1) % 3;
      const unsigned v = 1U << (axis + 2) % 3;
      const RasterPoint a = project(cornerOf(box, side));
      const RasterPoint c = project(cornerOf(box, side | u | v));
      m_raster.veil({a, project(cornerOf(box, side | u)), c}, colour, opacity);
      m_raster.veil({a, c, project(cornerOf(box, side | v))}, colour, opacity);
    }
  }

  void edges(const Box& box, Colour colour, double width, double nearer = 0.0) {
    const auto place = [&](unsigned corner) {
      RasterPoint point = project(cornerOf(box, corner));
      point.depth -= nearer;
      return point;
    };
    for (unsigned corner = 0; corner < 8; ++corner) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1U) != 0) continue;
        m_raster.line(place(corner), place(corner | 1U << axis), colour, width);
      }
    }
  }

  const ViewScene& m_scene;
  const ParallelCamera& m_camera;
  Raster& m_raster;
  Projection m_projection;
  Vec3 m_light{};
};

/// All models in grey, small.
Raster smallPictureOfAll(const ViewScene& scene, const ParallelCamera& camera) {
  Raster canvas(2 * kOverview.width, 2 * kOverview.height, kPaper);
  Drawing drawing(scene, camera, canvas);
  for (std::uint32_t model = 0; model < scene.modelCount; ++model) drawing.shape(model, kGrey);
  Raster result(kOverview.width, kOverview.height, kPaper);
  canvas.halveInto(result);
  const auto right = static_cast<double>(kOverview.width - 1);
  const auto bottom = static_cast<double>(kOverview.height - 1);
  const std::array<RasterPoint, 5> corners{{{0, 0, -kInFront},
                                            {right, 0, -kInFront},
                                            {right, bottom, -kInFront},
                                            {0, bottom, -kInFront},
                                            {0, 0, -kInFront}}};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) result.line(corners[i], corners[i + 1], kFrame, 1.0);
  return result;
}

bool isFirstSmaller(const ViewScene& scene, const Clash& clash) {
  const auto size = [&scene](std::uint32_t model) {
    const Box& box = scene.frames.front().boxes[model];
    const Vec3 extent = minus(box.max, box.min);
    return dot(extent, extent);
  };
  return size(clash.first) < size(clash.second);
}

/// By their shapes: what contains the other is see-through, and of two that are the same the second is.
void drawShapes(const ViewScene& scene, const Clash& clash, Drawing& drawing) {
  const ExactState state = clash.exact->state;
  const bool isGhost =
      state == ExactState::Contained || state == ExactState::Duplicate || state == ExactState::Undecided;
  if (!isGhost) {
    drawing.shape(clash.first, kFirst);
    drawing.shape(clash.second, kSecond);
  } else if (state == ExactState::Duplicate || isFirstSmaller(scene, clash)) {
    drawing.shape(clash.first, kFirst);
    drawing.ghost(clash.second, kSecond);
  } else {
    drawing.shape(clash.second, kSecond);
    drawing.ghost(clash.first, kFirst);
  }
  drawing.contact(*clash.exact);
}

/// By their boxes, with what they share.
void drawBoxes(const ViewScene& scene, const Clash& clash, Drawing& drawing) {
  drawing.model(clash.first, kFirst);
  if (clash.isSelf()) return;
  drawing.model(clash.second, kSecond);
  drawing.shared(placeOf(scene, clash));
}

}  // namespace

Projection::Projection(const ParallelCamera& camera, const Raster& raster)
    : m_camera(camera),
      m_right(cross(camera.direction, camera.up)),
      m_middle{static_cast<double>(raster.width()) / 2.0, static_cast<double>(raster.height()) / 2.0},
      m_scale(static_cast<double>(raster.height()) / camera.height) {}

RasterPoint Projection::operator()(const Vec3& p) const {
  const Vec3 from = minus(p, m_camera.centre);
  return {m_middle[0] + m_scale * dot(from, m_right), m_middle[1] - m_scale * dot(from, m_camera.up),
          dot(from, m_camera.direction) / m_camera.height};
}

Overview::Overview(const ViewScene& scene)
    : m_modelCount(scene.modelCount), m_camera(cameraOfAll(scene)), m_raster(smallPictureOfAll(scene, m_camera)) {}

void Overview::addTo(Raster& picture, const Box& place) const {
  constexpr std::size_t kMargin = 8;  // pixels
  if (m_modelCount <= 2 || picture.width() < m_raster.width() + kMargin ||
      picture.height() < m_raster.height() + kMargin)
    return;
  Raster part = m_raster;
  Vec3 middle = m_camera.centre;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double here = place.min[axis] / 2.0 + place.max[axis] / 2.0;
    if (std::isfinite(here)) middle[axis] = here;
  }
  RasterPoint mark = Projection(m_camera, part)(middle);
  mark.depth = -kInFront;
  for (const auto& [width, colour] : {std::pair{10.0, kPaper}, std::pair{7.0, kShared}})
    part.line(mark, mark, colour, width);
  picture.paste(part, picture.width() - part.width() - kMargin, picture.height() - part.height() - kMargin);
}

ClashPainter::ClashPainter(const ViewScene& scene)
    : m_scene(&scene),
      m_canvas(2 * kPicture.width, 2 * kPicture.height, kBackground),
      m_picture(kPicture.width, kPicture.height, kBackground) {}

Raster& ClashPainter::paint(const Clash& clash, const ParallelCamera& camera) {
  m_canvas.clear(kBackground);
  Drawing drawing(*m_scene, camera, m_canvas);
  if (clash.exact != nullptr && clash.exact->state != ExactState::NotExamined)
    drawShapes(*m_scene, clash, drawing);
  else
    drawBoxes(*m_scene, clash, drawing);
  m_canvas.halveInto(m_picture);
  return m_picture;
}

}  // namespace allpairs::view
