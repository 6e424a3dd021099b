// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "ClashPicture.h"
#include "MeshPart.h"
#include "Upright.h"

namespace allpairs::view {
namespace {

/// Where a camera may look from, around and down: parts to the right, ahead and up. The first is taken where all are equal.
constexpr std::array<Vec3, 9> kDirections{{{-0.48, 0.72, -0.50},
                                           {0.48, 0.72, -0.50},
                                           {-0.72, -0.48, -0.50},
                                           {0.72, -0.48, -0.50},
                                           {-0.85, 0.15, -0.50},
                                           {0.10, 0.86, -0.50},
                                           {-0.35, 0.50, -0.80},
                                           {-0.55, 0.80, -0.15},
                                           {-0.48, 0.72, 0.50}}};

ParallelCamera lookAlong(const Vec3& parts, const Upright& upright) {
  ParallelCamera camera;
  camera.direction = unit(upright.direction(parts));
  const Vec3 right = unit(cross(camera.direction, upright.up));
  camera.up = unit(cross(right, camera.direction));
  return camera;
}

double sizeOf(const Box& box) {
  const Vec3 extent = minus(box.max, box.min);
  return std::sqrt(dot(extent, extent));
}

void setCentre(ParallelCamera& camera, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double middle = box.min[axis] / 2.0 + box.max[axis] / 2.0;
    camera.centre[axis] = std::isfinite(middle) ? middle : 0.0;
  }
}

/// What a picture is of: both boxes, or what is shared and the smaller of two that differ much in size.
Box subjectOf(const ViewScene& scene, const Clash& clash) {
  constexpr double kMuchLarger = 4.0;
  const Box& a = scene.frames.front().boxes[clash.first];
  const Box& b = scene.frames.front().boxes[clash.second];
  const double sizeA = sizeOf(a);
  const double sizeB = sizeOf(b);
  if (sizeA > kMuchLarger * sizeB) return merge(placeOf(scene, clash), b);
  if (sizeB > kMuchLarger * sizeA) return merge(placeOf(scene, clash), a);
  return merge(a, b);
}

/// Sets what is in the picture: the contact with room around it, and no more than both models.
void frame(const ViewScene& scene, const Clash& clash, ParallelCamera& camera) {
  constexpr double kRoom = 1.15;
  constexpr double kRoomAroundContact = 3.0;
  constexpr double kLeastOfModel = 0.75;  // so that one sees what it is that clashes
  const Box subject = subjectOf(scene, clash);
  setCentre(camera, subject);
  const double size = sizeOf(subject) * kRoom;
  if (size > 0.0 && std::isfinite(size)) camera.height = size;
  if (clash.exact == nullptr || clash.exact->state == ExactState::NotExamined) return;
  const Box contact = placeOf(scene, clash);
  const double smaller =
      std::min(sizeOf(scene.frames.front().boxes[clash.first]), sizeOf(scene.frames.front().boxes[clash.second]));
  const double height = std::max(kRoomAroundContact * sizeOf(contact), kLeastOfModel * smaller);
  if (!(height < camera.height)) return;
  camera.height = height;
  setCentre(camera, contact);
}

/// A coarse picture in which only is counted what is seen of the two models and of their contact.
class Sighting {
 public:
  Sighting(const ViewScene& scene, const ParallelCamera& camera)
      : m_scene(scene), m_raster(kWidth, kHeight, {}), m_projection(camera, m_raster) {}

  /// How good it is: the less visible of both counts, and the contact if nothing hides it.
  double rate(const Clash& clash) {
    draw(clash.first, kFirst);
    draw(clash.second, kSecond);
    std::size_t first = 0;
    std::size_t second = 0;
    for (std::size_t y = 0; y < kHeight; ++y) {
      for (std::size_t x = 0; x < kWidth; ++x) {
        first += m_raster.at(x, y) == kFirst ? 1U : 0U;
        second += m_raster.at(x, y) == kSecond ? 1U : 0U;
      }
    }
    const auto least = static_cast<double>(std::min(first, second)) / (kWidth * kHeight);
    return std::min(least, kEnough) + kEnough * seenOfContact(*clash.exact);
  }

 private:
  static constexpr std::size_t kWidth = 80;
  static constexpr std::size_t kHeight = 60;
  static constexpr double kEnough = 0.15;              // of the picture: more is not better
  static constexpr std::size_t kMostTriangles = 3000;  // of more only some are drawn
  static constexpr Colour kFirst{1, 0, 0};
  static constexpr Colour kSecond{2, 0, 0};

  [[nodiscard]] RasterPoint project(const Vec3& p) const { return m_projection(p); }

  void draw(std::uint32_t model, Colour colour) {
    const auto indices = partOf(m_scene.mesh.triangles, m_scene.mesh.triangleEnds, model);
    const std::size_t step = 3 * (indices.size() / 3 / kMostTriangles + 1);
    for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
      m_raster.triangle({project(vertexOf(m_scene.mesh, indices[i])), project(vertexOf(m_scene.mesh, indices[i + 1])),
                         project(vertexOf(m_scene.mesh, indices[i + 2]))},
                        colour);
    }
  }

  /// The share of the lines of contact that nothing is in front of.
  double seenOfContact(const ExactPair& pair) {
    constexpr double kNear = 0.01;  // of the height: a line lies in both surfaces
    std::size_t seen = 0;
    for (const auto& [from, to] : pair.contactLines) {
      RasterPoint point = project({(from[0] + to[0]) / 2.0, (from[1] + to[1]) / 2.0, (from[2] + to[2]) / 2.0});
      seen += m_raster.isSeen({point.x, point.y, point.depth - kNear}) ? 1U : 0U;
    }
    return pair.contactLines.empty() ? 0.0 : static_cast<double>(seen) / static_cast<double>(pair.contactLines.size());
  }

  const ViewScene& m_scene;
  Raster m_raster;
  Projection m_projection;
};

}  // namespace

ParallelCamera cameraOfAll(const ViewScene& scene) {
  constexpr double kRoom = 1.05;
  Box all = kEmptyBox;
  for (const Box& box : scene.frames.front().boxes) {
    if (std::isfinite(sizeOf(box)) && !isEmpty(box)) all = merge(all, box);
  }
  ParallelCamera camera = lookAlong(kDirections.front(), uprightOf(scene.up));
  if (isEmpty(all)) return camera;
  setCentre(camera, all);
  if (const double size = kRoom * sizeOf(all); size > 0.0) camera.height = size;
  return camera;
}

ParallelCamera cameraOf(const ViewScene& scene, const Clash& clash) {
  const Upright upright = uprightOf(scene.up);
  ParallelCamera best = lookAlong(kDirections.front(), upright);
  frame(scene, clash, best);
  if (clash.exact == nullptr || !isContact(clash.exact->state)) return best;
  constexpr double kBetter = 1.05;  // the same side as in other pictures, unless another shows more
  double most = 0.0;
  for (const Vec3& parts : kDirections) {
    ParallelCamera camera = lookAlong(parts, upright);
    frame(scene, clash, camera);
    constexpr double kFromBelow = 0.7;  // or along the ground: nobody looks at things so
    const double rating = Sighting(scene, camera).rate(clash) * (parts[2] > -0.3 ? kFromBelow : 1.0);
    if (rating <= most * kBetter) continue;
    most = rating;
    best = camera;
  }
  return best;
}

}  // namespace allpairs::view
