// SPDX-License-Identifier: MIT
//
// A kind of model that the library doesn't know: a rope, whose elements are the spans between its knots. It says what
// box each span fills; the broad phase, its rules and its order are the library's.
#include <allpairs/collision/BruteForceBroadPhase.h>
#include <allpairs/collision/DiscreteIntersection.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

namespace collision = allpairs::collision;
using Knot = std::array<double, 3>;

class RopeModel final : public collision::CollisionModel {
 public:
  RopeModel(std::string name, double radius, std::vector<Knot> knots)
      : CollisionModel(std::move(name)), m_radius(radius), m_knots(std::move(knots)) {}

  [[nodiscard]] std::size_t getSize() const override { return m_knots.size() - 1; }
  [[nodiscard]] std::string_view typeName() const override { return "RopeModel"; }

  [[nodiscard]] allpairs::Box elementBox(std::size_t index) const override {
    allpairs::Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax(m_knots[index][axis], m_knots[index + 1][axis]);
      box.min[axis] = low - m_radius;
      box.max[axis] = high + m_radius;
    }
    return box;
  }

 private:
  double m_radius;
  std::vector<Knot> m_knots;
};

}  // namespace

int main() {
  RopeModel anchor("anchor line", 0.1, {{0, 0, 0}, {0, 4, 1}, {0, 8, 0}});
  RopeModel mooring("mooring line", 0.1, {{-1, 4, 1}, {3, 4, 1}});
  RopeModel tether("tether", 0.1, {{1, 4, 0}, {1, 4, 0.75}});
  mooring.setSelfCollision(true);                                             // it may wind around itself
  for (RopeModel* rope : {&anchor, &mooring, &tether}) rope->setOwner(rope);  // three bodies
  tether.setGroups({7});
  mooring.setGroups({7});  // two of one rig never meet

  collision::DiscreteIntersection method;
  method.setAlarmDistance(1.0);
  collision::BruteForceBroadPhase broadPhase;
  broadPhase.setIntersectionMethod(&method);
  broadPhase.init();
  broadPhase.beginBroadPhase();
  for (RopeModel* rope : {&anchor, &mooring, &tether}) broadPhase.addCollisionModel(rope);
  broadPhase.endBroadPhase();
  for (const auto& [first, second] : broadPhase.getCollisionModelPairs()) {
    std::cout << first->getName() << " and " << second->getName() << '\n';
  }
}
