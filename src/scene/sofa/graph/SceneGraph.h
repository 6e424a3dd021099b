// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "allpairs/scene/FileError.h"
#include "sofa/graph/ComponentKind.h"

namespace allpairs::scene::sofa {

/// Where in which file something was written.
struct Place {
  std::shared_ptr<const std::filesystem::path> file;
  std::size_t line = 0;
};

struct Attribute {
  std::string name;
  std::string value;
};

/// An attribute that nothing has asked for, and the name that was asked for in vain and is nearly the same.
struct LikelySlip {
  std::string_view name;
  std::string_view meant;
};

/// The attributes of an element, few and in the order of the file. What they are asked for is noted: by that a reader
/// needs no list of the names that it knows, to tell a slip from a name that is not for it.
class Attributes {
 public:
  [[nodiscard]] const std::string* find(std::string_view name) const;
  /// The value of an attribute, or else the default.
  [[nodiscard]] std::string_view value(std::string_view name, std::string_view standard = {}) const;
  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
  void set(std::string_view name, std::string_view value);

  /// Gives an attribute another value, if it is there.
  void replace(std::string_view name, std::string_view value);

  /// The attributes that are likely to be slips, as far as they have been asked for others until now.
  [[nodiscard]] std::vector<LikelySlip> slips() const;

  [[nodiscard]] auto begin() const { return m_entries.begin(); }
  [[nodiscard]] auto end() const { return m_entries.end(); }

 private:
  /// What is known of the one at the same place among the entries.
  struct Use {
    bool isAskedFor = false;
    std::string meant{};
  };

  void noteInVain(std::string_view name) const;

  std::vector<Attribute> m_entries;
  mutable std::vector<Use> m_uses;
};

struct Node;

/// One component of a scene: an element of the file that isn't a node.
struct Component {
  std::string type;  ///< The class, as the file calls it.
  std::string name;  ///< As given, or as SOFA would number it.
  bool isNamed = false;
  Attributes attributes;
  Place place;
  /// The file in whose folder it finds the files that it names: that of the node around it, whatever file it is from.
  std::shared_ptr<const std::filesystem::path> base;
  Node* node = nullptr;
  std::size_t index = 0;  ///< Among the components of its node.
  std::size_t order = 0;  ///< Among all of the scene, as they stand in the file; SOFA makes them in this order.
  ComponentClass what;

  [[nodiscard]] ComponentKind kind() const { return what.kind; }
  [[nodiscard]] std::string path() const;
  /// "MeshTopology 'mesh' (/Body/mesh)".
  [[nodiscard]] std::string describe() const;
};

[[nodiscard]] bool isModel(const Component& component);
[[nodiscard]] bool isTopology(const Component& component);
[[nodiscard]] bool isTopologicalMapping(const Component& component);
[[nodiscard]] bool isMapping(const Component& component);
[[nodiscard]] bool isState(const Component& component);
[[nodiscard]] bool isMethod(const Component& component);

/// One node of a scene, with what is in it.
struct Node {
  std::string name;  ///< As given, or as SOFA would number it; newer SOFA leaves it empty.
  bool isNamed = false;
  bool active = true;
  std::string badActivation;  ///< What `activated` is where it is neither true nor false.
  std::string gravity;        ///< As given; empty where it is not.
  Place place;
  std::shared_ptr<const std::filesystem::path> base;  ///< The file that it or a node around it is the outermost of.
  Node* parent = nullptr;
  /// Names of components, each of the first before its second when the simulation starts, whatever their order here.
  std::vector<std::pair<std::string, std::string>> order;
  std::vector<std::unique_ptr<Component>> components;
  std::vector<std::unique_ptr<Node>> children;
  /// The first of each name, once indexNames() was called.
  std::unordered_map<std::string_view, const Component*> componentByName;
  std::unordered_map<std::string_view, const Node*> childByName;
  /// Those that others look for most, in the order of `components`, likewise.
  std::vector<const Component*> states;
  std::vector<const Component*> topologies;

  /// "/Body/Surface"; empty for the root.
  [[nodiscard]] std::string path() const;
};

/// A component cannot be read or a position cannot be computed; names the file, the line, the component and the reason.
class Unplaceable : public FileError {
 public:
  Unplaceable(const Component& component, const std::string& reason);
  Unplaceable(const Place& place, const std::string& problem);

  [[nodiscard]] const std::string& reason() const noexcept { return m_reason; }

 private:
  std::string m_reason;
};

}  // namespace allpairs::scene::sofa
