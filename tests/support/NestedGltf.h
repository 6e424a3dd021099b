// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace allpairs::test {

/// A node of a glTF file.
struct Part {
  std::string name{};
  int place = 0;  ///< In hundredths along x, where it has a triangle that begins there; 0: it has none. All overlap.
  std::vector<Part> children{};
};

inline nlohmann::json nodeOf(const Part& part) {
  nlohmann::json node = nlohmann::json::object();
  if (!part.name.empty()) node["name"] = part.name;
  if (part.place == 0) return node;
  node["mesh"] = 0;
  node["translation"] = {0.01 * part.place, 0, 0};
  return node;
}

/// The text of a glTF file of these nodes and those below them.
inline std::string nestedGltf(const std::vector<Part>& parts) {
  nlohmann::json file = nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "nodes": [], "scenes": [{"nodes": []}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAIA/"}]})");
  nlohmann::json& nodes = file["nodes"];
  std::vector<std::pair<const Part*, std::size_t>> open;
  for (const Part& part : parts) {
    file["scenes"][0]["nodes"].push_back(nodes.size());
    open.emplace_back(&part, nodes.size());
    nodes.push_back(nodeOf(part));
  }
  while (!open.empty()) {
    const auto [part, number] = open.back();
    open.pop_back();
    for (const Part& child : part->children) {
      nodes[number]["children"].push_back(nodes.size());
      open.emplace_back(&child, nodes.size());
      nodes.push_back(nodeOf(child));
    }
  }
  return file.dump();
}

}  // namespace allpairs::test
