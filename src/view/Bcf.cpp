// SPDX-License-Identifier: MIT
#include "Bcf.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>
#include <vector>

#include "ClashPicture.h"
#include "Text.h"
#include "Zip.h"

namespace allpairs::view {
namespace {

using Node = pugi::xml_node;

std::string viewpointGuid(const Clash& clash) { return guidOf({clash.guid, "viewpoint"}); }

void addText(Node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(printable(text).c_str());
}

void addNumber(Node parent, const char* name, double value) { addText(parent, name, fmt::to_string(value)); }

/// Appends an element with one attribute.
Node addElement(Node parent, const char* name, const char* attribute, const std::string& value) {
  Node element = parent.append_child(name);
  element.append_attribute(attribute).set_value(value.c_str());
  return element;
}

std::string textOf(pugi::xml_document& document) {
  Node declaration = document.prepend_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("UTF-8");
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

std::string version() {
  pugi::xml_document document;
  addText(addElement(document.root(), "Version", "VersionId", "2.1"), "DetailedVersion", "2.1");
  return textOf(document);
}

std::string markup(const ViewScene& scene, const Clash& clash, const BcfOptions& options) {
  pugi::xml_document document;
  Node root = document.append_child("Markup");
  addText(addElement(root.append_child("Header"), "File", "isExternal", "true"), "Filename", scene.title);
  Node topic = addElement(root, "Topic", "Guid", clash.guid);
  topic.append_attribute("TopicType").set_value("Clash");
  topic.append_attribute("TopicStatus").set_value("Open");
  addText(topic, "Title", titleOf(scene, clash));
  addText(topic, "Index", std::to_string(clash.number));
  addText(topic, "CreationDate", options.date);
  addText(topic, "CreationAuthor", "Allpairs");
  const std::string more =
      clash.inside.empty() ? "" : fmt::format(" It is the worst of {} pairs.", clash.inside.size() + 1);
  addText(topic, "Description", findingOf(scene, clash) + more);
  Node viewpoints = addElement(root, "Viewpoints", "Guid", viewpointGuid(clash));
  addText(viewpoints, "Viewpoint", "viewpoint.bcfv");
  addText(viewpoints, "Snapshot", "snapshot.png");
  addText(viewpoints, "Index", "0");
  return textOf(document);
}

void addVector(Node parent, const char* name, const std::array<double, 3>& v) {
  Node vector = parent.append_child(name);
  addNumber(vector, "X", v[0]);
  addNumber(vector, "Y", v[1]);
  addNumber(vector, "Z", v[2]);
}

void addComponent(Node selection, const std::string& name) {
  Node component = selection.append_child("Component");
  addText(component, "OriginatingSystem", "Allpairs");
  addText(component, "AuthoringToolId", name);
}

/// The models of all pairs of a row, each once.
std::vector<std::uint32_t> modelsOf(const Clash& clash) {
  std::vector<std::uint32_t> models;
  const auto add = [&models](std::uint32_t model) {
    if (std::find(models.begin(), models.end(), model) == models.end()) models.push_back(model);
  };
  const auto addPair = [&add](const Clash& pair) {
    add(pair.first);
    add(pair.second);
  };
  addPair(clash);
  for (const Clash& pair : clash.inside) addPair(pair);
  return models;
}

void addCamera(Node parent, const ParallelCamera& camera, double metresPerUnit) {
  std::array<double, 3> eye{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    eye[axis] = (camera.centre[axis] - 2.0 * camera.height * camera.direction[axis]) * metresPerUnit;
  }
  Node element = parent.append_child("OrthogonalCamera");
  addVector(element, "CameraViewPoint", eye);
  addVector(element, "CameraDirection", camera.direction);
  addVector(element, "CameraUpVector", camera.up);
  addNumber(element, "ViewToWorldScale", camera.height * metresPerUnit);
}

std::string viewpoint(const ViewScene& scene, const Clash& clash, double metresPerUnit) {
  pugi::xml_document document;
  Node root = addElement(document.root(), "VisualizationInfo", "Guid", viewpointGuid(clash));
  Node components = root.append_child("Components");
  Node selection = components.append_child("Selection");
  for (const std::uint32_t model : modelsOf(clash)) addComponent(selection, scene.name(model));
  addElement(components, "Visibility", "DefaultVisibility", "true");
  addCamera(root, cameraOf(scene, clash), metresPerUnit);
  return textOf(document);
}

}  // namespace

std::string makeBcf(const ViewScene& scene, std::span<const Clash> clashes, const BcfOptions& options) {
  Zip archive;
  archive.add("bcf.version", version());
  for (const Clash& clash : clashes) {
    archive.add(clash.guid + "/markup.bcf", markup(scene, clash, options));
    archive.add(clash.guid + "/viewpoint.bcfv", viewpoint(scene, clash, options.metresPerUnit));
    archive.add(clash.guid + "/snapshot.png", options.picture(clash));
  }
  return archive.finish();
}

}  // namespace allpairs::view
