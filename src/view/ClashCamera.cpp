// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "ClashPicture.h"
#include "MeshPart.h"
#include "Upright.h"

namespace allpairs::view {
namespace {

/// Where a camera may look from, around and down: parts to the right, ahead and up. The first is taken where all are
/// equal.
constexpr std::array<Vec3, 9> kDirections{{{-0.48, 0.72, -0.50},
                                           {0.48, 0.72, -0.50},
                                           {-0.72, -0.48, -0.50},
                                           {0.72, -0.48, -0.50},
                                           {-0.85, 0.15, -0.50},
                                           {0.10, 0.86, -0.50},
                                           {-0.35, 0.50, -0.80},
                                           {-0.55, 0.80, -0.15},
                                           {-0.48, 0.72, 0.50}}};

constexpr std::uint8_t kNoSide = 255;

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

  /// How good it is, at most kBest: the less visible of both counts, and the contact if nothing hides it.
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

  static constexpr double kBest = 0.3;

 private:
  static constexpr std::size_t kWidth = 80;
  static constexpr std::size_t kHeight = 60;
  static constexpr double kEnough = kBest / 2.0;       // of the picture: more is not better
  static constexpr std::size_t kMostTriangles = 3000;  // of more only some are drawn
  static constexpr Colour kFirst{1, 0, 0};
  static constexpr Colour kSecond{2, 0, 0};

  [[nodiscard]] RasterPoint project(const Vec3& p) const { return m_projection(p); }

  void draw(std::uint32_t model, Colour colour) {
    const ViewMesh& mesh = m_scene.mesh;
    const std::span<const std::uint32_t> indices = partOf(mesh.triangles, mesh.triangleEnds, model);
    const std::size_t step = 3 * (indices.size() / 3 / kMostTriangles + 1);
    const auto corner = [&](std::size_t place) { return m_projection(vertexOf(mesh, indices[place])); };
    for (std::size_t i = 0; i + 2 < indices.size(); i += step)
      m_raster.triangle({corner(i), corner(i + 1), corner(i + 2)}, colour);
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

ParallelCamera cameraFrom(const ViewScene& scene, const Clash& clash, std::size_t side) {
  ParallelCamera camera = lookAlong(kDirections[side], uprightOf(scene.up));
  frame(scene, clash, camera);
  return camera;
}

/// The side from which most is seen of a contact.
std::size_t bestSide(const ViewScene& scene, const Clash& clash) {
  constexpr double kBetter = 1.05;    // the same side as in other pictures, unless another shows more
  constexpr double kFromBelow = 0.7;  // or along the ground: nobody looks at things so
  std::size_t best = 0;
  double most = 0.0;
  for (std::size_t side = 0; side < kDirections.size(); ++side) {
    const double weight = kDirections[side][2] > -0.3 ? kFromBelow : 1.0;
    if (weight * Sighting::kBest <= most * kBetter) continue;
    const ParallelCamera camera = cameraFrom(scene, clash, side);
    const double rating = weight * Sighting(scene, camera).rate(clash);
    if (rating <= most * kBetter) continue;
    most = rating;
    best = side;
  }
  return best;
}

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
  const bool hasContact = clash.exact != nullptr && isContact(clash.exact->state);
  const auto pair = static_cast<std::size_t>(hasContact ? clash.exact - scene.exact.data() : 0);
  if (!hasContact) return cameraFrom(scene, clash, 0);
  return cameraFrom(scene, clash, hasSide(scene, pair) ? scene.sides[pair] : bestSide(scene, clash));
}

bool hasSide(const ViewScene& scene, std::size_t pair) {
  return pair < scene.sides.size() && scene.sides[pair] != kNoSide;
}

void chooseSides(ViewScene& scene, std::size_t most, Executor& executor) {
  scene.sides.clear();
  std::vector<std::size_t> order = worstFirst(scene.exact);
  order.resize(std::min(order.size(), most));
  std::vector<std::uint8_t> sides(scene.exact.size(), kNoSide);
  executor.run(order.size(), [&](std::size_t i) {
    const std::size_t pair = order[i];
    if (isContact(scene.exact[pair].state))
      sides[pair] = static_cast<std::uint8_t>(bestSide(scene, clashOf(scene, pair)));
  });
  scene.sides = std::move(sides);
}

}  // namespace allpairs::view
