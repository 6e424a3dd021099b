// SPDX-License-Identifier: MIT
#include "input/ModelNames.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "input/UniqueNames.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBetween = " › ";

/// The last `parts` parts of a path.
std::string endOf(const fs::path& path, std::size_t parts) {
  const std::ptrdiff_t count = std::distance(path.begin(), path.end());
  auto begin = path.begin();
  std::advance(begin, std::max<std::ptrdiff_t>(0, count - static_cast<std::ptrdiff_t>(parts)));
  fs::path result;
  for (; begin != path.end(); ++begin) result /= *begin;
  return result.string();
}

/// Without the number that a reader put behind it: wheel of wheel#2.
std::string_view withoutNumber(std::string_view name) {
  const std::string_view rest = withoutDigits(name);
  return rest.size() < name.size() && rest.ends_with('#') ? rest.substr(0, rest.size() - 1) : name;
}

/// The names of a scene's models, as its files tell them apart.
class Naming {
 public:
  explicit Naming(const Scene& scene) : m_scene(scene), m_labels(fileLabels(scene.files)), m_bodies(m_labels.size()) {
    for (std::size_t i = 0; i < scene.models.size(); ++i) note(i);
  }

  [[nodiscard]] std::string nameOf(std::size_t model) const {
    const ModelSource& source = m_scene.sources[model];
    const std::string& label = m_labels[source.file];
    const std::string_view name = withoutNumber(source.name);
    if (label.empty() || !m_hasSeveralFiles || (!isShared(name) && !isGenericName(name))) return source.name;
    const bool saysNothing = isGenericName(name) || name == m_scene.files[source.file].filename().string();
    const bool isAlone = !m_bodies[source.file].hasSeveral;
    return isAlone && saysNothing ? label + source.name.substr(name.size())
                                  : label + std::string(kBetween) + source.name;
  }

 private:
  struct Bodies {
    std::optional<const void*> first{};
    bool hasSeveral = false;
  };

  void note(std::size_t model) {
    const ModelSource& source = m_scene.sources[model];
    const std::string& label = m_labels[source.file];
    const std::string*& known = m_files.emplace(withoutNumber(source.name), &label).first->second;
    if (known != nullptr && *known != label) known = nullptr;
    Bodies& bodies = m_bodies[source.file];
    const void* owner = m_scene.models[model]->getOwner();
    bodies.hasSeveral = bodies.hasSeveral || bodies.first.value_or(owner) != owner;
    bodies.first = bodies.first.value_or(owner);
    m_hasSeveralFiles = m_hasSeveralFiles || label != m_labels.front();
  }

  [[nodiscard]] bool isShared(std::string_view name) const { return m_files.at(name) == nullptr; }

  const Scene& m_scene;
  std::vector<std::string> m_labels;
  std::vector<Bodies> m_bodies;                                      ///< Of each file.
  std::unordered_map<std::string_view, const std::string*> m_files;  ///< That have a name; null: several.
  bool m_hasSeveralFiles = false;
};

bool isNamedByCaller(const Scene& scene, std::size_t model) {
  const ModelSource& source = scene.sources[model];
  return scene.models[model]->getName() != (source.given.empty() ? source.name : source.given);
}

void giveName(Scene& scene, std::size_t model, std::string name) {
  ModelSource& source = scene.sources[model];
  source.given = name == source.name ? std::string() : name;
  scene.models[model]->setName(std::move(name));
}

/// Gives numbers to the names in a range that are taken outside of it, and takes all of them.
void tellApart(std::span<std::string> names, UniqueNames& taken) {
  for (std::string& name : names) {
    if (taken.contains(name)) name = taken.unique(name);
  }
  for (const std::string& name : names) taken.add(name);
}

}  // namespace

void noteSources(Scene& scene, const fs::path& file) {
  if (scene.sources.size() == scene.models.size()) return;
  scene.files.push_back(file);
  while (scene.sources.size() < scene.models.size()) {
    scene.sources.push_back({.file = scene.files.size() - 1, .name = scene.models[scene.sources.size()]->getName()});
  }
}

std::vector<std::string> fileLabels(const std::vector<fs::path>& files) {
  const std::set<fs::path> different(files.begin(), files.end());
  std::map<fs::path, std::string> labels;
  std::vector<fs::path> left(different.begin(), different.end());
  for (std::size_t parts = 1; !left.empty(); ++parts) {
    std::map<std::string, std::size_t> counts;
    for (const fs::path& file : left) ++counts[endOf(file, parts)];
    std::vector<fs::path> alike;
    for (const fs::path& file : left) {
      const std::string label = endOf(file, parts);
      const bool isWhole = static_cast<std::ptrdiff_t>(parts) >= std::distance(file.begin(), file.end());
      if (counts[label] > 1 && !isWhole) {
        alike.push_back(file);
      } else {
        labels[file] = label;
      }
    }
    left = std::move(alike);
  }
  std::vector<std::string> result;
  result.reserve(files.size());
  for (const fs::path& file : files) result.push_back(labels[file]);
  return result;
}

bool isGenericName(std::string_view name) {
  // What modellers and exporters call an object that nobody named.
  static constexpr std::array<std::string_view, 24> kWords{
      "default",  "object", "mesh",  "solid", "part",  "body",     "cube",    "box",
      "cylinder", "sphere", "cone",  "torus", "plane", "circle",   "node",    "group",
      "geometry", "shape",  "model", "scene", "root",  "untitled", "unnamed", "openscad_model"};
  std::string_view stem = withoutDigits(withoutNumber(name));
  if (!stem.empty() && std::string_view("._- ").find(stem.back()) != std::string_view::npos) stem.remove_suffix(1);
  return std::find(kWords.begin(), kWords.end(), lowerCase(stem)) != kWords.end();
}

void nameModels(Scene& scene) {
  noteSources(scene, {});
  const Naming naming(scene);
  UniqueNames taken;
  std::vector<std::size_t> models;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.models.size(); ++i) {
    if (isNamedByCaller(scene, i)) {
      taken.add(scene.models[i]->getName());
    } else {
      models.push_back(i);
      names.push_back(naming.nameOf(i));
    }
  }
  for (std::size_t begin = 0, end = 0; begin < names.size(); begin = end) {
    while (end < names.size() && scene.sources[models[end]].file == scene.sources[models[begin]].file) ++end;
    tellApart(std::span(names).subspan(begin, end - begin), taken);
  }
  for (std::size_t i = 0; i < names.size(); ++i) giveName(scene, models[i], std::move(names[i]));
}

}  // namespace allpairs::scene
