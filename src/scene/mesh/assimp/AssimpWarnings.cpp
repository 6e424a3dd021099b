// SPDX-License-Identifier: MIT
#include "mesh/assimp/AssimpWarnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/assimp/IfcNames.h"

namespace allpairs::scene {

std::string notRead(const std::set<std::string>& kinds) {
  return fmt::format("{} {} not read", fmt::join(kinds, ", "), kinds.size() == 1 ? "is" : "are");
}

void warnOfMissing(const std::filesystem::path& path, const std::set<std::string>& kinds,
                   const std::vector<IfcProduct>& shapeless, std::vector<FileWarning>& warnings) {
  if (kinds.empty() && shapeless.empty()) return;
  std::unordered_set<std::string> ids;
  for (const IfcProduct& product : shapeless) ids.insert(product.id);
  if (kinds.empty()) ids = ifcProductsOfBoxes(readText(path), ids);  // of which Assimp says nothing
  std::vector<std::string> names;
  for (const IfcProduct& product : shapeless) {
    if (ids.contains(product.id)) names.push_back(product.name);
  }
  if (kinds.empty() && names.empty()) return;
  std::string reason = (kinds.empty() ? "IfcBoundingBox is not read" : notRead(kinds)) + ": ";
  reason += names.empty() ? "parts of products are missing" : "nothing is there of " + firstOf(names);
  if (!kinds.empty() && !names.empty()) reason += ", and parts of others may be missing";
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
