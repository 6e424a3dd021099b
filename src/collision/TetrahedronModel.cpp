// SPDX-License-Identifier: MIT
#include "allpairs/collision/TetrahedronModel.h"

namespace allpairs::collision {

TetrahedronModel::TetrahedronModel(std::string name, std::vector<Vec3> positions, std::vector<Tetrahedron> tetrahedra)
    : MeshModel(std::move(name), std::move(positions)), m_tetrahedra(std::move(tetrahedra)) {
  for (std::size_t i = 0; i < m_tetrahedra.size(); ++i) checkVertices(m_tetrahedra[i], i);
}

Span<const std::uint32_t> TetrahedronModel::verticesOf(std::size_t index, std::uint32_t& /*storage*/) const {
  return m_tetrahedra[index];
}

}  // namespace allpairs::collision
