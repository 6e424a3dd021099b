// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "SceneSpec.h"

namespace allpairs::test {

/// The rules for one pair, written from the contract; they share no code with the library, not even the box test.
struct SceneRules {
  const SceneSpec& scene;

  [[nodiscard]] static bool lets(const ModelSpec& a, const ModelSpec& b) {
    if (a.kind == Kind::Picky) return b.self;
    if (a.owner == b.owner) return a.self;
    const auto inB = [&b](int group) { return std::count(b.groups.begin(), b.groups.end(), group) > 0; };
    return std::none_of(a.groups.begin(), a.groups.end(), inB);
  }

  [[nodiscard]] static bool mayMeet(const ModelSpec& a, const ModelSpec& b) {
    if (!(a.simulated || b.simulated) || !lets(a, b) || !lets(b, a)) return false;
    return a.kind != Kind::Odd || b.kind != Kind::Odd;
  }

  [[nodiscard]] bool near(const ModelSpec& a, const ModelSpec& b) const {
    if (scene.method == Method::UserUnbounded) return a.box.min[1] <= b.box.max[1];
    const bool contact = scene.method == Method::Proximity || scene.method == Method::UserBounded;
    const double d = contact ? scene.alarm + a.contact + b.contact : scene.alarm;
    bool result = a.kind != Kind::Odd || b.kind == Kind::Odd || a.box.min[0] <= b.box.min[0];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result = result && a.box.min[axis] <= a.box.max[axis] && b.box.min[axis] <= b.box.max[axis];
      result = result && !(a.box.min[axis] > b.box.max[axis] + d) && !(b.box.min[axis] > a.box.max[axis] + d);
    }
    return result;
  }
};

/// The double loop that every strategy must agree with, in what it finds, its orientation and its order.
inline std::vector<IndexPair> sceneOracle(const SceneSpec& scene) {
  const SceneRules rules{scene};
  std::vector<IndexPair> pairs;
  std::vector<std::size_t> earlier;
  for (std::size_t m = 0; m < scene.models.size(); ++m) {
    const ModelSpec& a = scene.models[m];
    if (a.kind == Kind::Null || a.kind == Kind::Empty) continue;
    if (scene.region && !rules.near(a, {.box = *scene.region})) continue;
    if (a.kind != Kind::Odd && a.simulated && rules.lets(a, a) && rules.near(a, a)) pairs.emplace_back(m, m);
    for (const std::size_t e : earlier) {
      const ModelSpec& b = scene.models[e];
      if (!SceneRules::mayMeet(a, b)) continue;
      const bool swap = b.kind == Kind::Odd;
      if (rules.near(swap ? b : a, swap ? a : b)) pairs.emplace_back(swap ? e : m, swap ? m : e);
    }
    earlier.push_back(m);
  }
  return pairs;
}

}  // namespace allpairs::test
