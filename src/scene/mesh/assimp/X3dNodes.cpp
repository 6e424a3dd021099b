// SPDX-License-Identifier: MIT
#include "mesh/assimp/X3dNodes.h"

#include <new>
#include <pugixml.hpp>
#include <string_view>

#include "input/FileBytes.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

bool isX3dShape(std::string_view kind) {
  return isOneOf(
      kind, {"GeoElevationGrid", "IndexedQuadSet", "NurbsCurve", "NurbsPatchSurface", "NurbsSweptSurface",
             "NurbsSwungSurface", "NurbsTrimmedSurface", "ProtoInstance", "QuadSet", "Text", "NurbsSet", "VolumeData"});
}

bool isX3dGroup(std::string_view kind) {
  return isOneOf(kind,
                 {"Anchor",          "Billboard",     "CADAssembly",    "CADFace",       "CADLayer",    "CADPart",
                  "CollidableShape", "Collision",     "EspduTransform", "GeoLOD",        "GeoLocation", "GeoTransform",
                  "HAnimHumanoid",   "HAnimJoint",    "HAnimSegment",   "HAnimSite",     "LOD",         "Layer",
                  "LayerSet",        "LayoutGroup",   "LayoutLayer",    "PickableGroup", "ScreenGroup", "StaticGroup",
                  "Viewport",        "ViewpointGroup"});
}

/// Whether a node is a shape, or one that may be: another file, or a node elsewhere in this one.
bool mayBeShape(const pugi::xml_node& node) {
  const std::string_view kind = node.name();
  return kind == "Shape" || kind == "Inline" || isX3dShape(kind) || !node.attribute("USE").empty();
}

}  // namespace

std::set<std::string> x3dNodesOfShapes(const std::filesystem::path& path, const std::set<std::string>& kinds) {
  std::set<std::string> found;
  std::set<std::string_view> groups;
  for (const std::string& kind : kinds) {
    if (isX3dShape(kind)) found.insert(kind);
    if (isX3dGroup(kind)) groups.insert(kind);
  }
  if (groups.empty()) return found;
  const std::string text = readText(path);
  pugi::xml_document document;
  const auto result = document.load_buffer(text.data(), text.size());
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  static_cast<void>(document.find_node([&](const pugi::xml_node& node) {
    const auto group = groups.find(node.name());
    if (group == groups.end() || !node.find_node(mayBeShape)) return false;
    found.emplace(*group);
    groups.erase(group);
    return groups.empty();
  }));
  return found;
}

}  // namespace allpairs::scene
