// SPDX-License-Identifier: MIT
#include "allpairs/collision/LineModel.h"

namespace allpairs::collision {

LineModel::LineModel(std::string name, std::vector<Vec3> positions, std::vector<Line> lines)
    : MeshModel(std::move(name), std::move(positions)), m_lines(std::move(lines)) {
  for (std::size_t i = 0; i < m_lines.size(); ++i) checkVertices(m_lines[i], i);
}

Span<const std::uint32_t> LineModel::verticesOf(std::size_t index, std::uint32_t& /*storage*/) const {
  return m_lines[index];
}

}  // namespace allpairs::collision
