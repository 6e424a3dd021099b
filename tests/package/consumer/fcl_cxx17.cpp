// SPDX-License-Identifier: MIT
#include <allpairs/collision/SphereModel.h>
#include <allpairs/fcl/FclBroadPhaseManager.h>
#include <allpairs/fcl/FclNarrowPhase.h>
#include <fcl/geometry/shape/box.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "DoubleLoop.h"

static_assert(__cplusplus == 201703L, "what is linked asks for another standard");

namespace {

using Object = fcl::CollisionObject<double>;

struct Found {
  std::vector<std::unique_ptr<Object>> objects;
  Pairs pairs;

  [[nodiscard]] std::size_t numberOf(const Object* object) const {
    const auto isIt = [&](const std::unique_ptr<Object>& other) { return other.get() == object; };
    return static_cast<std::size_t>(std::find_if(objects.begin(), objects.end(), isIt) - objects.begin());
  }
};

void place(Object& object, const Row& row) {
  object.setTranslation({double{row[0]} + 1, double{row[1]} + 1, double{row[2]} + 1});
  object.computeAABB();
}

bool add(Object* first, Object* second, void* data) {
  Found& found = *static_cast<Found*>(data);
  found.pairs.push_back(std::minmax(found.numberOf(first), found.numberOf(second)));
  return false;
}

bool isManagerRight() {
  Found found;
  allpairs::FclBroadPhaseManagerd manager;
  for (const Row& row : someRows(200, 1)) {
    found.objects.push_back(std::make_unique<Object>(std::make_shared<fcl::Box<double>>(2, 2, 2)));
    place(*found.objects.back(), row);
    manager.registerObject(found.objects.back().get());
  }
  bool isRight = true;
  for (std::uint32_t step = 1; step < 6; ++step) {
    const std::vector<Row> rows = someRows(found.objects.size(), step);
    for (std::size_t i = 0; i < rows.size(); ++i) place(*found.objects[i], rows[i]);
    manager.update();
    found.pairs.clear();
    manager.collide(&found, add);
    std::sort(found.pairs.begin(), found.pairs.end());
    const Pairs expected = byDoubleLoop(rows);
    isRight = isRight && !expected.empty() && found.pairs == expected;
  }
  return isRight;
}

bool isNarrowPhaseRight() {
  allpairs::collision::SphereModel first("first", {{0, 0, 0}});
  allpairs::collision::SphereModel second("second", {{0, 0, 1.5}});
  allpairs::FclNarrowPhase phase;
  phase.beginNarrowPhase();
  phase.addCollisionPair({&first, &second});
  return phase.pairs().front().depth == 0.5;
}

}  // namespace

int main() { return isManagerRight() && isNarrowPhaseRight() ? EXIT_SUCCESS : EXIT_FAILURE; }
