// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "allpairs/Span.h"
#include "allpairs/collision/MeshModel.h"

namespace allpairs::collision {

/// Line segments. The box of each bounds its two points, enlarged by the contact distance.
///
/// Bad input: a number that is not finite, or an index past the points, throws InvalidArgument.
class LineModel : public MeshModel {
 public:
  using Line = std::array<std::uint32_t, 2>;

  LineModel(std::string name, std::vector<Vec3> positions, std::vector<Line> lines);

  [[nodiscard]] const std::vector<Line>& lines() const { return m_lines; }

  [[nodiscard]] std::size_t getSize() const override { return m_lines.size(); }
  [[nodiscard]] std::string_view typeName() const override { return "TLineModel"; }

 protected:
  [[nodiscard]] Span<const std::uint32_t> verticesOf(std::size_t index, std::uint32_t& storage) const override;

 private:
  std::vector<Line> m_lines;
};

}  // namespace allpairs::collision
