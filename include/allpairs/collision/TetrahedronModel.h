// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "allpairs/Span.h"
#include "allpairs/collision/MeshModel.h"

namespace allpairs::collision {

/// Tetrahedra. The box of each bounds its points; the contact distance does not enlarge it.
///
/// Bad input: a number that is not finite, or an index past the points, throws InvalidArgument.
class TetrahedronModel : public MeshModel {
 public:
  using Tetrahedron = std::array<std::uint32_t, 4>;

  TetrahedronModel(std::string name, std::vector<Vec3> positions, std::vector<Tetrahedron> tetrahedra);

  [[nodiscard]] const std::vector<Tetrahedron>& tetrahedra() const { return m_tetrahedra; }

  [[nodiscard]] std::size_t getSize() const override { return m_tetrahedra.size(); }
  [[nodiscard]] std::string_view typeName() const override { return "TetrahedronModel"; }

 protected:
  [[nodiscard]] Span<const std::uint32_t> verticesOf(std::size_t index, std::uint32_t& storage) const override;
  [[nodiscard]] double margin() const override { return 0.0; }

 private:
  std::vector<Tetrahedron> m_tetrahedra;
};

}  // namespace allpairs::collision
