// SPDX-License-Identifier: MIT
#pragma once

#include <rapidcheck.h>

#include <limits>
#include <vector>

#include "SceneSpec.h"

namespace allpairs::test {

/// Coordinates that make boxes touch, coincide, vanish and overflow: few values, chosen to meet each other.
inline rc::Gen<double> anyCoordinate() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return rc::gen::weightedOneOf<double>(
      {{8, rc::gen::map(rc::gen::inRange(0, 7), [](int i) { return 0.5 * i; })},
       {3, rc::gen::map(rc::gen::inRange(0, 30), [](int i) { return 0.1 * i; })},
       {1, rc::gen::map(rc::gen::inRange(-3, 4), [](int i) { return 1.0 + i * 0x1p-52; })},
       {1, rc::gen::element(-0.0, 1e-320, -5e-324, 1e30, -1e30, 3.5e38, 1e300, -1e300, kInfinity, -kInfinity)}});
}

/// Boxes; one in twelve is turned over on an axis, and so empty unless it is flat there.
inline rc::Gen<Box> anyBox() {
  const auto corners = rc::gen::container<std::array<double, 6>>(anyCoordinate());
  return rc::gen::map(rc::gen::pair(corners, rc::gen::inRange(0, 36)), [](const auto& drawn) {
    const auto& [c, inverted] = drawn;
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(c[axis], c[axis + 3]);
      box.max[axis] = std::max(c[axis], c[axis + 3]);
      if (static_cast<std::size_t>(inverted) == axis) std::swap(box.min[axis], box.max[axis]);
    }
    return box;
  });
}

inline rc::Gen<ModelSpec> anyModel() {
  using rc::gen::element;
  using rc::gen::set;
  const auto kind = rc::gen::weightedElement<Kind>(
      {{8, Kind::Library}, {3, Kind::User}, {2, Kind::Picky}, {2, Kind::Odd}, {1, Kind::Empty}, {1, Kind::Null}});
  const auto groups = rc::gen::weightedOneOf<std::vector<int>>(
      {{3, rc::gen::just(std::vector<int>{})},
       {1, rc::gen::resize(3, rc::gen::container<std::vector<int>>(element(-1, 0, 1, 2, 64, 65)))}});
  return rc::gen::build<ModelSpec>(
      set(&ModelSpec::kind, kind), set(&ModelSpec::box, anyBox()),
      set(&ModelSpec::simulated, rc::gen::weightedElement<bool>({{3, true}, {1, false}})),
      set(&ModelSpec::self, rc::gen::arbitrary<bool>()), set(&ModelSpec::owner, rc::gen::inRange(0, 12)),
      set(&ModelSpec::groups, groups),
      set(&ModelSpec::contact,
          rc::gen::weightedElement<double>({{4, 0.0}, {1, 0.1}, {1, 0.3}, {1, 0.5}, {1, -0.25}, {1, 1e-17}})),
      set(&ModelSpec::again, rc::gen::weightedElement<bool>({{15, false}, {1, true}})));
}

/// Models that come again are the one before, in everything.
inline std::vector<ModelSpec> repeated(std::vector<ModelSpec> models) {
  if (!models.empty()) models.front().again = false;
  for (std::size_t i = 1; i < models.size(); ++i) {
    if (!models[i].again) continue;
    models[i] = models[i - 1];
    models[i].again = true;
  }
  return models;
}

inline rc::Gen<SceneSpec> anyScene() {
  using rc::gen::element;
  using rc::gen::set;
  const auto models =
      rc::gen::map(rc::gen::scale(0.6, rc::gen::container<std::vector<ModelSpec>>(anyModel())), repeated);
  const auto region = rc::gen::weightedElement<std::optional<Box>>(
      {{3, std::nullopt}, {1, Box{{0.5, 0.5, 0.5}, {1.5, 2.0, 2.5}}}, {1, Box{{-1e30, 0.0, 1.0}, {1.0, 1.0, 1.1}}}});
  return rc::gen::build<SceneSpec>(
      set(&SceneSpec::models, models),
      set(&SceneSpec::method, rc::gen::weightedElement<Method>({{2, Method::Discrete},
                                                                {4, Method::Proximity},
                                                                {2, Method::ProximityWithoutContact},
                                                                {2, Method::UserBounded},
                                                                {1, Method::UserUnbounded}})),
      set(&SceneSpec::alarm, element(0.0, 0.0, 0.1, 0.3, 0.5, 1.0, -0.1, -0.5, 1e300, 0x1p-53)),
      set(&SceneSpec::region, region));
}

}  // namespace allpairs::test
