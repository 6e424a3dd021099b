// SPDX-License-Identifier: MIT
#include "view/Bodies.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <tuple>
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

/// The folder that two are in, or are.
std::filesystem::path commonPart(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::filesystem::path common;
  const auto [end, ignored] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  for (auto part = a.begin(); part != end; ++part) common /= *part;
  return common;
}

/// Puts bodies together of their models.
class BodyMaker {
 public:
  BodyMaker(const scene::Scene& scene, Grouping grouping, const view::ViewScene& shown)
      : m_scene(scene), m_grouping(grouping), m_shown(shown), m_paths(ownerPaths(scene)) {
    if (isByFile()) m_files = fileNames(scene);
    m_fileIdentities = fileIdentities(scene);
  }

  void add(std::size_t model) {
    const auto [place, isNew] = m_numbers.emplace(keyOf(model), static_cast<std::uint32_t>(m_all.size()));
    if (isNew) m_all.push_back(first(model));
    Body& body = m_all[place->second];
    if (++body.size == 2 && !isByFile()) describeSeveral(model, body);
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

  /// What models of one body have in common: their file, and its part or their owner.
  using Key = std::tuple<std::size_t, std::string, const void*>;

  [[nodiscard]] bool isByFile() const { return m_grouping == Grouping::File; }

  /// The part of its file that a model is of; empty: that of its owner.
  [[nodiscard]] const std::string& partOf(std::size_t model) const {
    const scene::ModelSource& source = m_scene.sources[model];
    return m_grouping == Grouping::Assembly && !source.assembly.empty() ? source.assembly : source.body;
  }

  [[nodiscard]] Key keyOf(std::size_t model) const {
    const std::size_t file = m_scene.sources[model].file;
    if (isByFile()) return {file, "", nullptr};
    const std::string& part = partOf(model);
    return {file, part, part.empty() ? m_scene.models[model]->getOwner() : nullptr};
  }

  [[nodiscard]] Body first(std::size_t model) const {
    const std::size_t file = m_scene.sources[model].file;
    if (!isByFile() || m_files[file].empty()) return {m_scene.models[model]->getName(), m_shown.identities[model]};
    return {m_files[file], m_fileIdentities[file]};
  }

  /// By its part of the file, or the path of its node, instead of one of its models, with what stands before: "arm.scn
  /// › /Arm".
  void describeSeveral(std::size_t model, Body& body) const {
    const scene::ModelSource& source = m_scene.sources[model];
    std::string part = partOf(model);
    const bool isBody = part == source.body;
    const bool hasPath = part.empty() && !source.path.empty();
    if (part.empty()) {
      const auto path = m_paths.find(m_scene.models[model]->getOwner());
      if (path == m_paths.end()) return;
      part = path->second->empty() ? "/" : *path->second;
    }
    if (m_grouping == Grouping::Assembly && !source.assemblyId.empty())
      body.identity = source.assemblyId;
    else if (source.id.empty() || !isBody)
      body.identity = m_fileIdentities[source.file] + '\n' + (hasPath ? source.path : part);
    const std::string& name = m_scene.models[model]->getName();
    const std::size_t place = name.rfind(source.name);
    if (place != std::string::npos) body.name = name.substr(0, place) + part;
  }

  const scene::Scene& m_scene;
  Grouping m_grouping;
  const view::ViewScene& m_shown;
  OwnerPaths m_paths;
  std::vector<std::string> m_files;
  std::vector<std::string> m_fileIdentities;
  std::map<Key, std::uint32_t> m_numbers;
  std::vector<Body> m_all;
  std::vector<std::uint32_t> m_bodies;
};

}  // namespace

std::string Identities::unique(std::string identity) {
  const std::size_t count = ++m_counts[identity];
  return count == 1 ? identity : identity + '\n' + std::to_string(count);
}

std::vector<std::string> fileIdentities(const scene::Scene& scene) {
  std::vector<std::filesystem::path> paths;
  std::map<std::string, std::filesystem::path> folders;  // that the files of a name have in common
  for (const auto& file : scene.files) {
    std::error_code problem;
    const std::filesystem::path path = std::filesystem::absolute(file, problem);
    paths.push_back(problem ? file : path.lexically_normal());
    const std::filesystem::path folder = paths.back().parent_path();
    const auto [common, isNew] = folders.emplace(paths.back().filename().string(), folder);
    if (!isNew) common->second = commonPart(common->second, folder);
  }
  std::vector<std::string> names;
  for (const auto& path : paths) {
    const std::string name = path.filename().string();
    names.push_back(path.parent_path() == folders[name] ? name
                                                        : path.lexically_relative(folders[name]).generic_string());
  }
  return names;
}

void addBodies(const scene::Scene& from, Grouping grouping, view::ViewScene& to) {
  if (grouping == Grouping::None || from.sources.size() != from.models.size()) return;
  BodyMaker maker(from, grouping, to);
  for (std::size_t i = 0; i < from.models.size(); ++i) maker.add(i);
  maker.giveTo(to);
}

}  // namespace allpairs::app
