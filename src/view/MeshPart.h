// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ClashPicture.h"
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

/// The triangles of a model with their vertices in a picture, each projected once, however many triangles share it.
struct ProjectedTriangles {
  ProjectedTriangles(const ViewMesh& mesh, std::uint32_t model, const Projection& projection)
      : indices(partOf(mesh.triangles, mesh.triangleEnds, model)) {
    if (indices.empty()) return;
    // A model's vertices are in one row.
    const auto [least, most] = std::minmax_element(indices.begin(), indices.end());
    m_first = *least;
    m_points.reserve(*most - *least + 1);
    for (std::uint32_t i = *least; i <= *most; ++i) m_points.push_back(projection(vertexOf(mesh, i)));
  }

  /// The triangle whose first index has this place.
  [[nodiscard]] std::array<RasterPoint, 3> at(std::size_t place) const {
    return {m_points[indices[place] - m_first], m_points[indices[place + 1] - m_first],
            m_points[indices[place + 2] - m_first]};
  }

  std::span<const std::uint32_t> indices;

 private:
  std::uint32_t m_first = 0;
  std::vector<RasterPoint> m_points;
};

}  // namespace allpairs::view
