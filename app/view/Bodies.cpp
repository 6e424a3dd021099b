// SPDX-License-Identifier: MIT
#include "view/Bodies.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace allpairs::app {
namespace {

using OwnerPaths = std::unordered_map<const void*, const std::string*>;

OwnerPaths ownerPaths(const scene::Scene& scene) {
  OwnerPaths paths;
  for (const auto& owner : scene.owners) paths.emplace(owner.get(), &owner->path);
  return paths;
}

/// Files by their names, or where several are called so by their paths.
std::vector<std::string> fileNames(const scene::Scene& scene) {
  std::map<std::string, std::set<std::string>> paths;
  for (const auto& file : scene.files) paths[file.filename().string()].insert(file.string());
  std::vector<std::string> names;
  for (const auto& file : scene.files) {
    const std::string name = file.filename().string();
    names.push_back(paths[name].size() > 1 ? file.string() : name);
  }
  return names;
}

/// Puts bodies together of their models.
class BodyMaker {
 public:
  BodyMaker(const scene::Scene& scene, Grouping grouping, const view::ViewScene& shown)
      : m_scene(scene), m_isByFile(grouping == Grouping::File), m_shown(shown), m_paths(ownerPaths(scene)) {
    if (m_isByFile) m_files = fileNames(scene);
  }

  void add(std::size_t model) {
    const std::size_t file = m_scene.sources[model].file;
    const std::pair key(file, m_isByFile ? nullptr : m_scene.models[model]->getOwner());
    const auto [place, isNew] = m_numbers.emplace(key, static_cast<std::uint32_t>(m_all.size()));
    if (isNew) m_all.push_back(first(model));
    Body& body = m_all[place->second];
    if (++body.size == 2 && !m_isByFile) describeSeveral(model, body);
    m_bodies.push_back(place->second);
  }

  /// Gives the result to what is shown, unless each body is one model.
  void giveTo(view::ViewScene& to) {
    if (m_all.size() == m_bodies.size()) return;
    Identities identities;
    for (Body& body : m_all) {
      to.bodyNames.push_back(std::move(body.name));
      to.bodyIdentities.push_back(identities.unique(std::move(body.identity)));
    }
    to.bodies = std::move(m_bodies);
  }

 private:
  struct Body {
    std::string name;
    std::string identity;
    std::size_t size = 0;
  };

  [[nodiscard]] Body first(std::size_t model) const {
    const std::size_t file = m_scene.sources[model].file;
    if (!m_isByFile || m_files[file].empty()) return {m_scene.models[model]->getName(), m_shown.identities[model]};
    return {m_files[file], m_scene.files[file].filename().string()};
  }

  /// By the path of its node instead of that of one of its models, with what stands before: "arm.scn › /Arm".
  void describeSeveral(std::size_t model, Body& body) const {
    const scene::ModelSource& source = m_scene.sources[model];
    const auto path = m_paths.find(m_scene.models[model]->getOwner());
    if (path == m_paths.end()) return;
    if (source.id.empty()) body.identity = m_scene.files[source.file].filename().string() + '\n' + *path->second;
    const std::string& name = m_scene.models[model]->getName();
    const std::size_t place = name.rfind(source.name);
    if (place != std::string::npos) body.name = name.substr(0, place) + (path->second->empty() ? "/" : *path->second);
  }

  const scene::Scene& m_scene;
  bool m_isByFile;
  const view::ViewScene& m_shown;
  OwnerPaths m_paths;
  std::vector<std::string> m_files;
  std::map<std::pair<std::size_t, const void*>, std::uint32_t> m_numbers;
  std::vector<Body> m_all;
  std::vector<std::uint32_t> m_bodies;
};

}  // namespace

std::string Identities::unique(std::string identity) {
  const std::size_t count = ++m_counts[identity];
  return count == 1 ? identity : identity + '\n' + std::to_string(count);
}

void addBodies(const scene::Scene& from, Grouping grouping, view::ViewScene& to) {
  if (grouping == Grouping::None || from.sources.size() != from.models.size()) return;
  BodyMaker maker(from, grouping, to);
  for (std::size_t i = 0; i < from.models.size(); ++i) maker.add(i);
  maker.giveTo(to);
}

}  // namespace allpairs::app
