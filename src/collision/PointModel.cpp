// SPDX-License-Identifier: MIT
#include "allpairs/collision/PointModel.h"

namespace allpairs::collision {

PointModel::PointModel(std::string name, std::vector<Vec3> positions)
    : MeshModel(std::move(name), std::move(positions)) {}

Span<const std::uint32_t> PointModel::verticesOf(std::size_t index, std::uint32_t& storage) const {
  storage = static_cast<std::uint32_t>(index);
  return {&storage, 1};
}

}  // namespace allpairs::collision
