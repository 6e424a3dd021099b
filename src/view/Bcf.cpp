// SPDX-License-Identifier: MIT
#include "Bcf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "ClashPicture.h"
#include "Text.h"
#include "Zip.h"

namespace allpairs::view {
namespace {

using Node = pugi::xml_node;

constexpr const char* kClash = "Clash";
constexpr const char* kContact = "Contact";
constexpr const char* kClearance = "Clearance";
constexpr const char* kUndecided = "Undecided";

std::string viewpointGuid(const Clash& clash) { return guidOf({clash.guid, "viewpoint"}); }

/// Where there is no memory, pugixml says so instead of throwing.
void requireMade(bool isMade) {
  if (!isMade) throw std::bad_alloc();
}

Node addNode(Node parent, const char* name) {
  Node node = parent.append_child(name);
  requireMade(!node.empty());
  return node;
}

void addAttribute(Node element, const char* name, const std::string& value) {
  requireMade(element.append_attribute(name).set_value(value.c_str()));
}

void addText(Node parent, const char* name, const std::string& text) {
  requireMade(addNode(parent, name).text().set(printable(text).c_str()));
}

void addNumber(Node parent, const char* name, double value) { addText(parent, name, fmt::to_string(value)); }

/// Appends an element with one attribute.
Node addElement(Node parent, const char* name, const char* attribute, const std::string& value) {
  Node element = addNode(parent, name);
  addAttribute(element, attribute, value);
  return element;
}

/// A stream would drop what there is no memory for.
struct TextWriter final : pugi::xml_writer {
  void write(const void* data, std::size_t size) override { text.append(static_cast<const char*>(data), size); }

  std::string text{};
};

std::string textOf(pugi::xml_document& document) {
  Node declaration = document.prepend_child(pugi::node_declaration);
  addAttribute(declaration, "version", "1.0");
  addAttribute(declaration, "encoding", "UTF-8");
  TextWriter writer;
  document.save(writer, "  ");
  return writer.text;
}

std::string version(BcfVersion version) {
  pugi::xml_document document;
  if (version == BcfVersion::V30) {
    addElement(document.root(), "Version", "VersionId", "3.0");
  } else {
    addText(addElement(document.root(), "Version", "VersionId", "2.1"), "DetailedVersion", "2.1");
  }
  return textOf(document);
}

/// The words that topics use, which 3.0 wants declared.
std::string extensions() {
  pugi::xml_document document;
  Node root = addNode(document.root(), "Extensions");
  Node types = addNode(root, "TopicTypes");
  for (const char* type : {kClash, kContact, kClearance, kUndecided}) addText(types, "TopicType", type);
  Node statuses = addNode(root, "TopicStatuses");
  for (const char* status : {"Open", "In progress", "Accepted", "Closed"})  // as in web/src/notes.js
    addText(statuses, "TopicStatus", status);
  Node labels = addNode(root, "TopicLabels");
  for (const Change change : {Change::New, Change::Persisting, Change::Resolved})
    addText(labels, "TopicLabel", std::string(changeName(change)));
  return textOf(document);
}

/// What is wrong: a clash, or something less.
const char* topicTypeOf(const Clash& clash) {
  if (clash.exact == nullptr) return kClash;
  switch (clash.exact->state) {
    case ExactState::Touching:
      return kContact;
    case ExactState::WithinClearance:
      return kClearance;
    case ExactState::Undecided:
    case ExactState::NotExamined:
      return kUndecided;
    default:
      return kClash;
  }
}

/// What a topic says besides its viewpoint.
struct TopicText {
  std::string guid;
  std::string status;
  std::string title;
  std::string description;
  std::string type = kClash;
  std::string label{};     ///< Empty: none.
  std::size_t number = 0;  ///< 0: none.
};

TopicText topicOf(const ViewScene& scene, const Clash& clash) {
  const std::string more =
      clash.inside.empty() ? "" : fmt::format(" It is the worst of {} pairs.", clash.inside.size() + 1);
  TopicText topic{clash.guid, std::string(topicStatusOf(clash)), titleOf(scene, clash),
                  findingOf(scene, clash) + more + beforeText(clash)};
  if (clash.since) topic.label = changeName(*clash.since);
  topic.type = topicTypeOf(clash);
  topic.number = clash.number;
  return topic;
}

TopicText topicOf(const EarlierClash& clash) {
  TopicText topic{clash.guid, "Closed", clash.first + " and " + clash.second,
                  "It was in the report before, and is none any more."};
  topic.label = changeName(Change::Resolved);
  return topic;
}

void addHeader(Node root, const ViewScene& scene, bool isThree) {
  Node header = addNode(root, "Header");
  Node files = isThree ? addNode(header, "Files") : header;
  addText(addElement(files, "File", isThree ? "IsExternal" : "isExternal", "true"), "Filename", scene.title);
}

Node addTopic(Node root, const TopicText& text, const BcfOptions& options) {
  const bool isThree = options.version == BcfVersion::V30;
  Node topic = addElement(root, "Topic", "Guid", text.guid);
  addAttribute(topic, "TopicType", text.type);
  addAttribute(topic, "TopicStatus", text.status);
  addText(topic, "Title", text.title);
  if (text.number != 0) addText(topic, "Index", std::to_string(text.number));
  if (!text.label.empty())
    isThree ? addText(addNode(topic, "Labels"), "Label", text.label) : addText(topic, "Labels", text.label);
  addText(topic, "CreationDate", options.date);
  addText(topic, "CreationAuthor", "Allpairs");
  addText(topic, "Description", text.description);
  return topic;
}

void addViewpoint(Node parent, const char* name, const Clash& clash) {
  Node viewpoint = addElement(parent, name, "Guid", viewpointGuid(clash));
  addText(viewpoint, "Viewpoint", "viewpoint.bcfv");
  addText(viewpoint, "Snapshot", "snapshot.png");
  addText(viewpoint, "Index", "0");
}

/// With a viewpoint of the clash that is pictured, if one is.
std::string markup(const ViewScene& scene, const TopicText& text, const Clash* pictured, const BcfOptions& options) {
  const bool isThree = options.version == BcfVersion::V30;
  pugi::xml_document document;
  Node root = addNode(document.root(), "Markup");
  addHeader(root, scene, isThree);
  Node topic = addTopic(root, text, options);
  if (pictured != nullptr && isThree) addViewpoint(addNode(topic, "Viewpoints"), "ViewPoint", *pictured);
  if (pictured != nullptr && !isThree) addViewpoint(root, "Viewpoints", *pictured);
  return textOf(document);
}

void addVector(Node parent, const char* name, const std::array<double, 3>& v) {
  Node vector = addNode(parent, name);
  addNumber(vector, "X", v[0]);
  addNumber(vector, "Y", v[1]);
  addNumber(vector, "Z", v[2]);
}

bool isIfcGuid(const std::string& id) {
  constexpr std::size_t kLength = 22;
  return id.size() == kLength && std::all_of(id.begin(), id.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
         });
}

void addComponent(Node parent, const ViewScene& scene, std::uint32_t model) {
  Node component = addNode(parent, "Component");
  if (!scene.ids.empty() && isIfcGuid(scene.ids[model])) addAttribute(component, "IfcGuid", scene.ids[model]);
  addText(component, "OriginatingSystem", "Allpairs");
  const std::string name = printable(scene.name(model));
  const bool isBlank = name.find_first_not_of(' ') == std::string::npos;
  addText(component, "AuthoringToolId", isBlank ? fmt::format("model {}", model) : name);
}

/// The two models of a row in the colours of its picture.
void addColouring(Node components, const ViewScene& scene, const Clash& clash, bool isThree) {
  constexpr std::array<const char*, 2> kColours{"FF0072B2", "FFE69F00"};  // opaque blue and orange
  Node colouring = addNode(components, "Coloring");
  for (std::size_t i = 0; i < (clash.isSelf() ? 1U : 2U); ++i) {
    Node colour = addElement(colouring, "Color", "Color", kColours[i]);
    addComponent(isThree ? addNode(colour, "Components") : colour, scene, i == 0 ? clash.first : clash.second);
  }
}

/// The models of all pairs of a row, each once, and each GlobalId once.
std::vector<std::uint32_t> modelsOf(const ViewScene& scene, const Clash& clash) {
  std::vector<std::uint32_t> models;
  const auto isSame = [&scene](std::uint32_t a, std::uint32_t b) {
    return a == b || (!scene.ids.empty() && !scene.ids[a].empty() && scene.ids[a] == scene.ids[b]);
  };
  const auto add = [&](std::uint32_t model) {
    if (std::none_of(models.begin(), models.end(), [&](std::uint32_t known) { return isSame(known, model); }))
      models.push_back(model);
  };
  const auto addPair = [&add](const Clash& pair) {
    add(pair.first);
    add(pair.second);
  };
  addPair(clash);
  for (const Clash& pair : clash.inside) addPair(pair);
  return models;
}

void addCamera(Node parent, const ParallelCamera& camera, const BcfOptions& options) {
  constexpr double kAspectRatio = 4.0 / 3.0;  // of the pictures
  std::array<double, 3> eye{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    eye[axis] = (camera.centre[axis] - 2.0 * camera.height * camera.direction[axis]) * options.metresPerUnit;
  }
  Node element = addNode(parent, "OrthogonalCamera");
  addVector(element, "CameraViewPoint", eye);
  addVector(element, "CameraDirection", camera.direction);
  addVector(element, "CameraUpVector", camera.up);
  addNumber(element, "ViewToWorldScale", camera.height * options.metresPerUnit);
  if (options.version == BcfVersion::V30) addNumber(element, "AspectRatio", kAspectRatio);
}

std::string viewpoint(const ViewScene& scene, const Clash& clash, const BcfOptions& options) {
  pugi::xml_document document;
  Node root = addElement(document.root(), "VisualizationInfo", "Guid", viewpointGuid(clash));
  Node components = addNode(root, "Components");
  Node selection = addNode(components, "Selection");
  for (const std::uint32_t model : modelsOf(scene, clash)) addComponent(selection, scene, model);
  addElement(components, "Visibility", "DefaultVisibility", "true");
  addColouring(components, scene, clash, options.version == BcfVersion::V30);
  addCamera(root, cameraOf(scene, clash), options);
  return textOf(document);
}

}  // namespace

std::string_view topicStatusOf(const Clash& clash) { return clash.since == Change::Resolved ? "Closed" : "Open"; }

std::string makeBcf(const ViewScene& scene, std::span<const Clash> clashes, const BcfOptions& options) {
  Zip archive(options.date);
  archive.add("bcf.version", version(options.version));
  if (options.version == BcfVersion::V30) archive.add("extensions.xml", extensions());
  for (const Clash& clash : clashes) {
    archive.add(clash.guid + "/markup.bcf", markup(scene, topicOf(scene, clash), &clash, options));
    archive.add(clash.guid + "/viewpoint.bcfv", viewpoint(scene, clash, options));
    archive.add(clash.guid + "/snapshot.png", options.picture(clash));
  }
  for (const EarlierClash& clash : options.gone)
    archive.add(clash.guid + "/markup.bcf", markup(scene, topicOf(clash), nullptr, options));
  return archive.finish();
}

}  // namespace allpairs::view
