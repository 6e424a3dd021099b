// SPDX-License-Identifier: MIT
#include "view/Bodies.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

namespace allpairs::app {
namespace {

using OwnerPaths = std::unordered_map<const void*, const std::string*>;

OwnerPaths ownerPaths(const scene::Scene& scene) {
  OwnerPaths paths;
  for (const auto& owner : scene.owners) paths.emplace(owner.get(), &owner->path);
  return paths;
}

/// A file by its name, or where another one has it too by its path.
std::string fileName(const scene::Scene& scene, std::size_t model) {
  const auto& file = scene.files[scene.sources[model].file];
  if (file.empty()) return scene.models[model]->getName();
  const bool isOneOfSeveral = std::any_of(scene.files.begin(), scene.files.end(), [&file](const auto& other) {
    return other.filename() == file.filename() && other != file;
  });
  return isOneOfSeveral ? file.string() : file.filename().string();
}

/// A body by the path of its node instead of that of one of its models, with what stands before: "arm.scn › /Arm".
std::string nameOfSeveral(const scene::Scene& scene, std::size_t model, const OwnerPaths& paths) {
  const std::string& name = scene.models[model]->getName();
  const auto path = paths.find(scene.models[model]->getOwner());
  const std::size_t place = name.rfind(scene.sources[model].name);
  if (path == paths.end() || place == std::string::npos) return name;
  return name.substr(0, place) + (path->second->empty() ? "/" : *path->second);
}

}  // namespace

void addBodies(const scene::Scene& from, Grouping grouping, view::ViewScene& to) {
  if (grouping == Grouping::None || from.sources.size() != from.models.size()) return;
  const OwnerPaths paths = ownerPaths(from);
  std::map<std::pair<std::size_t, const void*>, std::uint32_t> numbers;
  std::vector<std::uint32_t> bodies;
  std::vector<std::string> names;
  std::vector<std::string> identities;
  std::vector<std::size_t> sizes;
  const auto identityOf = [&](std::size_t model, bool isOneOfSeveral) {
    const std::string file = from.files[from.sources[model].file].filename().string();
    if (grouping == Grouping::File) return file;
    const auto path = paths.find(from.models[model]->getOwner());
    return isOneOfSeveral && path != paths.end() ? file + '\n' + *path->second : to.identities[model];
  };
  for (std::size_t i = 0; i < from.models.size(); ++i) {
    const bool isByFile = grouping == Grouping::File;
    const std::pair key(from.sources[i].file, isByFile ? nullptr : from.models[i]->getOwner());
    const auto [body, isNew] = numbers.emplace(key, static_cast<std::uint32_t>(names.size()));
    if (isNew) {
      names.push_back(isByFile ? fileName(from, i) : from.models[i]->getName());
      sizes.push_back(0);
      identities.emplace_back();
    }
    if (++sizes[body->second] == 2 && !isByFile) names[body->second] = nameOfSeveral(from, i, paths);
    if (sizes[body->second] < 3) identities[body->second] = identityOf(i, sizes[body->second] > 1);
    bodies.push_back(body->second);
  }
  if (names.size() == from.models.size()) return;
  to.bodies = std::move(bodies);
  to.bodyNames = std::move(names);
  to.bodyIdentities = std::move(identities);
}

}  // namespace allpairs::app
