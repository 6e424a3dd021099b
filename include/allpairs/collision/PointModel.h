// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/Span.h"
#include "allpairs/collision/MeshModel.h"

namespace allpairs::collision {

/// Points. The box of each is the point, enlarged by the contact distance.
///
/// Bad input: a number that is not finite throws InvalidArgument.
class PointModel : public MeshModel {
 public:
  PointModel(std::string name, std::vector<Vec3> positions);

  [[nodiscard]] std::size_t getSize() const override { return positions().size(); }
  [[nodiscard]] std::string_view typeName() const override { return "TPointModel"; }

 protected:
  [[nodiscard]] Span<const std::uint32_t> verticesOf(std::size_t index, std::uint32_t& storage) const override;
};

}  // namespace allpairs::collision
