// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "allpairs/Span.h"
#include "allpairs/collision/MeshModel.h"

namespace allpairs::collision {

/// Triangles, and quads as two triangles each. The box of each bounds its points, enlarged by the contact distance.
///
/// The elements are the triangles in their order, then for each quad (a, b, c, d) the triangles (a, b, c) and
/// (a, c, d).
///
/// Bad input: a number that is not finite, or an index past the points, throws InvalidArgument.
class TriangleModel : public MeshModel {
 public:
  using Triangle = std::array<std::uint32_t, 3>;
  using Quad = std::array<std::uint32_t, 4>;

  TriangleModel(std::string name, std::vector<Vec3> positions, std::vector<Triangle> triangles,
                const std::vector<Quad>& quads = {});

  /// The elements: the given triangles, then two for each quad.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return m_triangles; }

  /// Whether the boxes have cones of normals, which exclude that a nearly flat patch touches itself.
  [[nodiscard]] bool getUseCurvature() const { return m_useCurvature; }
  void setUseCurvature(bool useCurvature);

  [[nodiscard]] std::size_t getSize() const override { return m_triangles.size(); }
  [[nodiscard]] NormalCone elementCone(std::size_t index) const override;
  [[nodiscard]] NormalCone elementSweptCone(std::size_t index, double dt) const override;
  [[nodiscard]] std::string_view typeName() const override { return "TTriangleModel"; }

 protected:
  [[nodiscard]] Span<const std::uint32_t> verticesOf(std::size_t index, std::uint32_t& storage) const override;

 private:
  [[nodiscard]] Vec3 normalAt(std::size_t index, double dt) const;

  std::vector<Triangle> m_triangles;
  bool m_useCurvature = false;
};

}  // namespace allpairs::collision
