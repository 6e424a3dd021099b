// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "allpairs/Span.h"
#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

/// Base of the models whose elements join points of a mesh: points, lines, triangles, tetrahedra.
class MeshModel : public CollisionModel {
 public:
  [[nodiscard]] const std::vector<Vec3>& positions() const { return m_positions; }

  /// Moves the points.
  ///
  /// Bad input: a number that is not finite, or another number of points, throws InvalidArgument.
  void setPositions(std::vector<Vec3> positions);

  /// One velocity per point, for continuous methods; an empty vector means that nothing moves.
  ///
  /// Bad input: a wrong length or a number that is not finite throws InvalidArgument.
  void setVelocities(std::vector<Vec3> velocities);
  [[nodiscard]] const std::vector<Vec3>& velocities() const { return m_velocities; }

  /// The position of point `vertex`, dt after the start of the step.
  [[nodiscard]] Vec3 positionAt(std::uint32_t vertex, double dt) const;

  [[nodiscard]] Box elementBox(std::size_t index) const override;
  [[nodiscard]] Box elementSweptBox(std::size_t index, double dt) const override;

 protected:
  MeshModel(std::string name, std::vector<Vec3> positions);

  /// The points that an element joins. The span of a point's own index may lie in `storage`.
  [[nodiscard]] virtual Span<const std::uint32_t> verticesOf(std::size_t index, std::uint32_t& storage) const = 0;

  /// How far element boxes extend beyond their points.
  [[nodiscard]] virtual double margin() const { return getContactDistance(); }

  /// Throws InvalidArgument, naming model and element, if a vertex is not one of the points.
  void checkVertices(Span<const std::uint32_t> vertices, std::size_t element) const;

 private:
  std::vector<Vec3> m_positions;
  std::vector<Vec3> m_velocities;
};

}  // namespace allpairs::collision
