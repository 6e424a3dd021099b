// SPDX-License-Identifier: MIT
#include "mesh/AssimpWarnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace allpairs::scene {

std::string firstOf(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) text += (i == 0 ? "'" : ", '") + names[i] + '\'';
  if (names.size() > kNamed) text += fmt::format(" and {} more", names.size() - kNamed);
  return text;
}

std::string notRead(const std::set<std::string>& kinds) {
  std::string text;
  for (const std::string& kind : kinds) text += (text.empty() ? "" : ", ") + kind;
  return text + (kinds.size() == 1 ? " is not read" : " are not read");
}

void warnOfMissing(const std::set<std::string>& kinds, const std::vector<std::string>& shapeless,
                   std::vector<FileWarning>& warnings) {
  if (kinds.empty()) return;
  std::string reason = notRead(kinds) + ": ";
  reason += shapeless.empty() ? "parts of products are missing"
                              : "nothing is there of " + firstOf(shapeless) + ", and parts of others may be missing";
  warnings.push_back({"shapes", std::move(reason)});
}

void warnOfRounding(const std::vector<MeshObject>& objects, double metresPerUnit, std::vector<FileWarning>& warnings) {
  double farthest = 0.0;
  Point min{};
  Point max{};
  bool isFirst = true;
  for (const MeshObject& object : objects) {
    for (const Point& point : object.positions) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        farthest = std::max(farthest, std::abs(point[axis]));
        min[axis] = isFirst ? point[axis] : std::min(min[axis], point[axis]);
        max[axis] = isFirst ? point[axis] : std::max(max[axis], point[axis]);
      }
      isFirst = false;
    }
  }
  constexpr double kFar = 1000.0;        // times the size
  constexpr double kMostMetres = 0.001;  // that are not worth a word
  const double rounding = 0x1p-23 * farthest;
  const double extent = std::max({max[0] - min[0], max[1] - min[1], max[2] - min[2]});
  const bool isFar = farthest > kFar * extent && extent > 0.0;
  if (!std::isfinite(farthest) || !(isFar || rounding * metresPerUnit > kMostMetres)) return;
  warnings.push_back(
      {"coordinates", fmt::format("up to {:.3g} from the origin, where they are rounded by up to {:.3g}; "
                                  "move the model nearer to it",
                                  farthest, rounding)});
}

}  // namespace allpairs::scene
