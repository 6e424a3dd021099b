// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "VectorMath.h"
#include "ViewScene.h"

namespace allpairs::view {

/// The indices of one model among those of all.
[[nodiscard]] inline std::span<const std::uint32_t> partOf(const std::vector<std::uint32_t>& indices,
                                                           const std::vector<std::uint32_t>& ends,
                                                           std::uint32_t model) {
  if (ends.empty()) return {};
  const std::size_t begin = model == 0 ? 0 : ends[model - 1];
  return std::span(indices).subspan(begin, ends[model] - begin);
}

[[nodiscard]] inline Vec3 vertexOf(const ViewMesh& mesh, std::uint32_t i) {
  const double* p = &mesh.vertices[std::size_t{i} * 3];
  return {p[0], p[1], p[2]};
}

}  // namespace allpairs::view
