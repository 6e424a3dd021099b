// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "allpairs/Box.h"
#include "support/Boxes.h"

namespace allpairs::test {

/// What a model of a test scene is made as.
enum class Kind {
  Library,  ///< BoxModel
  User,     ///< a user's model that says its size and boxes and nothing else
  Picky,    ///< a user's model that collides only with what may collide with itself, whatever else
  Odd,      ///< its root has a type of its own: an intersector serves (Odd, other), and none (Odd, Odd)
  Empty,    ///< no elements
  Null,     ///< a null pointer
};

/// A model of a test scene, as plain data.
struct ModelSpec {
  Kind kind = Kind::Library;
  Box box;
  bool simulated = true;
  bool self = false;
  int owner = 1;  ///< 0 is none
  std::vector<int> groups = {};
  double contact = 0.0;
  bool again = false;  ///< not a new model, but the one before in the scene once more
};

/// Which intersection method a test scene uses.
enum class Method {
  Discrete,
  Proximity,
  ProximityWithoutContact,
  UserBounded,    ///< a user's subclass of a proximity method
  UserUnbounded,  ///< a user's method that can't bound its distance, and looks at y alone
};

/// A whole step of the broad phase, as plain data.
struct SceneSpec {
  std::vector<ModelSpec> models;
  Method method = Method::Proximity;
  double alarm = 0.0;
  std::optional<Box> region;
};

using IndexPair = std::pair<std::size_t, std::size_t>;

inline std::ostream& operator<<(std::ostream& out, const ModelSpec& model) {
  static constexpr const char* kNames[] = {"Library", "User", "Picky", "Odd", "Empty", "Null"};
  out << "\n  " << kNames[static_cast<int>(model.kind)] << ' ' << model.box << (model.simulated ? "" : " static")
      << (model.self ? " self" : "") << (model.again ? " again" : "") << " owner " << model.owner << " contact "
      << model.contact << " groups {";
  for (const int group : model.groups) out << ' ' << group;
  return out << " }";
}

inline std::ostream& operator<<(std::ostream& out, const SceneSpec& scene) {
  out << "method " << static_cast<int>(scene.method) << ", alarm " << scene.alarm;
  if (scene.region) out << ", region " << *scene.region;
  for (const ModelSpec& model : scene.models) out << model;
  return out;
}

}  // namespace allpairs::test
