// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "allpairs/collision/SolidModel.h"

namespace allpairs::collision {

/// Spheres. The box of each extends radius + contact distance from its centre.
class SphereModel : public SolidModel {
 public:
  static constexpr double kDefaultRadius = 1.0;

  /// `radii` may be shorter than `centres`: the rest get `radius`.
  ///
  /// Bad input: a centre or radius that is not finite, a negative radius, or more radii than centres throws
  ///            InvalidArgument.
  SphereModel(std::string name, std::vector<Vec3> centres, std::vector<double> radii = {},
              double radius = kDefaultRadius);

  [[nodiscard]] const std::vector<Vec3>& centres() const { return m_centres; }
  [[nodiscard]] const std::vector<double>& radii() const { return m_radii; }

  /// Moves the spheres. Bad input: as in the constructor; their number must stay the same.
  void setCentres(std::vector<Vec3> centres);

  [[nodiscard]] std::size_t getSize() const override { return m_centres.size(); }
  [[nodiscard]] std::string_view typeName() const override { return "TSphereModel"; }

 protected:
  [[nodiscard]] Box boxAt(std::size_t index, const Vec3& offset) const override;

 private:
  std::vector<Vec3> m_centres;
  std::vector<double> m_radii;
};

}  // namespace allpairs::collision
