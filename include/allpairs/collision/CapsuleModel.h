// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "allpairs/collision/SolidModel.h"

namespace allpairs::collision {

/// All points within `radius` of the segment between two ends.
struct Capsule {
  static constexpr double kDefaultRadius = 0.5;

  Vec3 begin{};
  Vec3 end{};
  double radius = kDefaultRadius;
};

/// Capsules. The box of each bounds its two ends, enlarged by the radius; the contact distance does not enlarge it.
///
/// Bad input: an end or radius that is not finite, or a negative radius, throws InvalidArgument.
class CapsuleModel : public SolidModel {
 public:
  CapsuleModel(std::string name, std::vector<Capsule> capsules);

  [[nodiscard]] const std::vector<Capsule>& capsules() const { return m_capsules; }

  /// Replaces the capsules. Another number of them removes the velocities.
  void setCapsules(std::vector<Capsule> capsules);

  [[nodiscard]] std::size_t getSize() const override { return m_capsules.size(); }
  [[nodiscard]] std::string_view typeName() const override { return "TCapsuleModel"; }

 protected:
  [[nodiscard]] Box boxAt(std::size_t index, const Vec3& offset) const override;

 private:
  std::vector<Capsule> m_capsules;
};

}  // namespace allpairs::collision
