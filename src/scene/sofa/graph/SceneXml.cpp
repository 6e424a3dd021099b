// SPDX-License-Identifier: MIT
#include "sofa/graph/SceneXml.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <pugixml.hpp>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/LineIndex.h"
#include "input/Words.h"
#include "sofa/graph/Values.h"

namespace allpairs::scene::sofa {
namespace {

constexpr std::size_t kMaxDepth = 200;            // No scene nests deeper than a dozen; the stack must not overflow.
constexpr std::ptrdiff_t kMostAttributes = 1000;  // SOFA's components take some dozens; each is compared with all.
constexpr std::size_t kMaxIncludeDepth = 32;      // Includes of includes of includes: scenes use three.
constexpr std::size_t kBytesPerElement = 1000;    // In memory, besides its attributes.
constexpr std::size_t kBytesPerValue = 100;       // Of an attribute, besides its text.

/// An element of a scene file on its way to a node or a component.
struct Element {
  enum class Splice { Keep, Children, Merge };

  bool isNode = false;
  bool isOutermost = false;  ///< Of its file.
  std::string type;
  std::string name;
  bool isNamed = true;
  Attributes attributes;
  Attributes replacements;
  std::vector<Element> children;
  Splice splice = Splice::Keep;
  Place place;
};

/// Where the markup ends that begins here and holds no attributes, if it is of such a kind: a comment, say.
std::size_t endOfOtherMarkup(std::string_view text, std::size_t at) {
  static constexpr std::string_view kKinds[][2] = {
      {"<!--", "-->"}, {"<?", "?>"}, {"<![CDATA[", "]]>"}, {"<!", ">"}, {"</", ">"}};
  for (const auto& [start, end] : kKinds) {
    if (!text.substr(at).starts_with(start)) continue;
    const auto found = text.find(end, at + start.size());
    return found == std::string_view::npos ? text.size() : found + end.size();
  }
  return at;
}

/// Puts a blank between attributes that follow one another without one, as TinyXML-2 lets them.
std::string withAttributesApart(std::string text) {
  std::string result;
  std::size_t copied = 0;
  for (auto at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    if (const auto end = endOfOtherMarkup(text, at); end != at) {
      at = end;
      continue;
    }
    for (++at; at < text.size() && text[at] != '>' && text[at] != '<'; ++at) {
      if (text[at] != '"' && text[at] != '\'') continue;
      at = text.find(text[at], at + 1);
      if (at == std::string::npos || at + 1 == text.size()) break;
      if (isBlankOrLineEnd(text[at + 1]) || text[at + 1] == '/' || text[at + 1] == '>') continue;
      result.append(text, copied, at + 1 - copied).push_back(' ');
      copied = at + 1;
    }
    if (at == std::string::npos) break;
  }
  return copied == 0 ? text : result.append(text, copied);
}

/// One scene file, or one file that it includes.
struct SourceFile {
  std::shared_ptr<const std::filesystem::path> path;
  std::string text;
  LineIndex lines;
  pugi::xml_document document;

  SourceFile(const std::filesystem::path& file, const StopFlag* stop)
      : path(std::make_shared<const std::filesystem::path>(file)),
        text(withAttributesApart(readText(file, stop))),
        lines(text) {
    refuseUtf16(text, file);
    const auto result = document.load_buffer(text.data(), text.size());
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result) {
      const auto [line, column] = lines.at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)));
      throw FileError(file, std::string{"not well-formed XML: "} + result.description(), line, column);
    }
    if (!document.document_element()) throw FileError(file, "there is no element in this scene");
  }

  [[nodiscard]] Place placeOf(const pugi::xml_node& node) const {
    return {path, lines.at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0))).line};
  }
};

/// What an include puts in the place of attributes of what it includes.
struct Replacement {
  std::string_view name;
  std::string_view value;
  std::string_view onlyIn;  ///< The element of that name alone; all where it is empty.
};

void setReplacement(Element& element, const Replacement& replacement, ReadScope& scope) {
  if (replacement.onlyIn.empty() || element.name == replacement.onlyIn) {
    scope.take(kBytesPerValue + replacement.value.size());
    element.replacements.set(replacement.name, replacement.value);
  }
  for (auto& child : element.children) setReplacement(child, replacement, scope);
}

Element::Splice spliceOf(std::string_view name) {
  if (name == "Group" || name == "_Group_") return Element::Splice::Children;
  return name == "_Merge_" ? Element::Splice::Merge : Element::Splice::Keep;
}

void merge(Element& into, Element&& from, ReadScope& scope) {
  scope.checkStop();
  if (!scope.takeWork(std::uint64_t{into.children.size() + from.children.size()} * from.children.size()))
    throw Unplaceable(from.place, "merging its elements takes too long; a larger --max-memory allows more");
  for (const auto& [name, value] : from.attributes) into.attributes.set(name, value);
  for (auto& child : from.children) {
    scope.checkStop();
    const auto same = std::ranges::find_if(into.children, [&](const Element& other) {
      return other.type == child.type && other.name == child.name && other.isNode == child.isNode;
    });
    if (same != into.children.end())
      merge(*same, std::move(child), scope);
    else
      into.children.push_back(std::move(child));
  }
}

void addChild(Element& parent, Element&& child, ReadScope& scope) {
  switch (child.splice) {
    case Element::Splice::Keep:
      parent.children.push_back(std::move(child));
      break;
    case Element::Splice::Children:
      std::ranges::move(child.children, std::back_inserter(parent.children));
      break;
    case Element::Splice::Merge:
      merge(parent, std::move(child), scope);
      break;
  }
}

/// Reads elements, follows includes, and numbers what has no name.
class ElementReader {
 public:
  explicit ElementReader(ReadScope& scope) : m_scope(scope) {}

  Element readFile(const std::filesystem::path& path) {
    if (m_openFiles.size() >= kMaxIncludeDepth) throw FileError(path, "included too many levels deep");
    const auto canonical = path.lexically_normal();  // A link that hides a circle runs into the depth above.
    if (std::ranges::find(m_openFiles, canonical) != m_openFiles.end())
      throw FileError(path, "this file includes itself, directly or through another");
    m_openFiles.push_back(canonical);
    auto& file = m_files[canonical];
    if (!file) {
      m_scope.admit(path);
      file = std::make_unique<SourceFile>(path, m_scope.stop());
    }
    auto root = read(*file, file->document.document_element());
    m_openFiles.pop_back();
    const bool isIncluded = !m_openFiles.empty();
    if (!root || (!root->isNode && !isIncluded))
      throw FileError(path,
                      std::string{"the outermost element of "} +
                          (isIncluded ? "an included file must be a Node or a component" : "a scene must be a Node"));
    root->isOutermost = true;
    return std::move(*root);
  }

 private:
  /// SOFA's parser refuses an attribute that is given twice; ours would take the last.
  static void checkAttributes(const SourceFile& file, const pugi::xml_node& xml) {
    const auto attributes = xml.attributes();
    const auto others = xml.children("Attribute");
    if (std::max(std::distance(attributes.begin(), attributes.end()), std::distance(others.begin(), others.end())) >
        kMostAttributes)
      throw Unplaceable(file.placeOf(xml), fmt::format("an element has more than {} attributes", kMostAttributes));
    for (const auto& attribute : xml.attributes())
      if (xml.attribute(attribute.name()) != attribute)
        throw Unplaceable(file.placeOf(xml), "not well-formed XML: two attributes of an element have the same name");
  }

  std::optional<Element> read(const SourceFile& file, const pugi::xml_node& xml) {
    checkAttributes(file, xml);
    if (std::string_view{xml.name()} == "include") return readInclude(file, xml, xml.attribute("href").value());
    auto element = makeElement(file, xml);
    if (!element) return element;
    if (!element->isNode && classOf(element->type).kind == ComponentKind::Other)
      if (const auto file2 = replacementFor(element->type, *file.path)) return readInclude(file, xml, *file2);
    if (element->name.empty()) {
      element->name = numberedName(*element);
      element->isNamed = false;
    }
    if (++m_depth > kMaxDepth) throw Unplaceable(element->place, "nodes are nested too deep");
    for (const auto& child : xml.children())
      if (child.type() == pugi::node_element)
        if (auto read = this->read(file, child)) addChild(*element, std::move(*read), m_scope);
    --m_depth;
    return element;
  }

  /// <Attribute type="radius"><Data value="3"/></Attribute>; the last of several counts.
  void addAttributeElements(const pugi::xml_node& xml, Element& element) {
    for (const auto& child : xml.children("Attribute")) {
      std::string value;
      for (const auto& data : child.children("Data")) value = data.attribute("value").value();
      const std::string_view name = child.attribute("type").value();
      m_scope.take(kBytesPerValue + 2 * value.size());
      if (name == "name")
        element.name = value;
      else
        element.attributes.set(name, value);
    }
  }

  std::optional<Element> makeElement(const SourceFile& file, const pugi::xml_node& xml) {
    m_scope.take(kBytesPerElement);  // includes can double with every level
    const std::string_view tag = xml.name();
    const bool typed = xml.attribute("type");
    Element element;
    element.place = file.placeOf(xml);
    element.isNode = tag == "Node";
    if (tag == "Attribute" || tag == "Data") return std::nullopt;
    if (!element.isNode && tag != "Object" && typed) return std::nullopt;  // SOFA makes nothing of such an element.
    element.type = tag == "Object" ? xml.attribute("type").value() : xml.name();
    element.name = xml.attribute("name").value();
    for (const auto& attribute : xml.attributes()) {
      const std::string_view name = attribute.name();
      m_scope.take(kBytesPerValue + 2 * std::string_view{attribute.value()}.size());
      if (name != "name" && name != "type") element.attributes.set(name, attribute.value());
    }
    if (!element.isNode) addAttributeElements(xml, element);
    return element;
  }

  std::optional<Element> readInclude(const SourceFile& file, const pugi::xml_node& xml, const std::string& name) {
    const auto place = file.placeOf(xml);
    if (name.empty()) throw Unplaceable(place, "an include without href");
    const auto found = m_scope.find(name, *file.path);
    if (!found.problem.empty()) throw Unplaceable(place, "the included file '" + name + "' " + found.problem);
    auto included = readFile(found.path);
    included.splice = spliceOf(included.name);
    for (const auto& attribute : xml.attributes()) replace(included, attribute.name(), attribute.value());
    return included;
  }

  void replace(Element& included, std::string_view name, std::string_view value) const {
    if (name == "href") return;
    if (name == "name") {
      included.name = value;
      included.isNamed = !value.empty();
      included.splice = spliceOf(value);
    } else if (const auto split = name.find("__"); split != std::string_view::npos && split > 0) {
      setReplacement(included, {name.substr(split + 2), value, name.substr(0, split)}, m_scope);
    } else {
      setReplacement(included, {name, value, {}}, m_scope);
    }
  }

  /// Old scenes write <TorusFEM .../> for the file Objects/TorusFEM.xml.
  std::optional<std::string> replacementFor(const std::string& type, const std::filesystem::path& from) const {
    std::string name = "Objects/" + type + ".xml";
    if (type.find('/') == std::string::npos && m_scope.find(name, from).problem.empty()) return name;
    return std::nullopt;
  }

  std::string numberedName(const Element& element) {
    const auto stem = element.isNode ? std::string{} : defaultNameStem(element.type);
    return stem + std::to_string(++m_counters[stem]);
  }

  ReadScope& m_scope;
  std::vector<std::filesystem::path> m_openFiles;
  std::map<std::filesystem::path, std::unique_ptr<SourceFile>> m_files;
  std::map<std::string, std::size_t> m_counters;
  std::size_t m_depth = 0;
};

void addComponent(Node& node, Element&& element, std::size_t order) {
  auto component = std::make_unique<Component>();
  component->what = classOf(element.type);
  component->type = std::move(element.type);
  component->name = std::move(element.name);
  component->isNamed = element.isNamed;
  component->attributes = std::move(element.attributes);
  for (const auto& [name, value] : element.replacements) {
    if (name == "name")
      component->name = value;
    else
      component->attributes.replace(name, value);
  }
  component->place = element.place;
  component->base = node.base;
  component->node = &node;
  component->index = node.components.size();
  component->order = order;
  node.components.push_back(std::move(component));
}

/// Makes a node, its parent's or the outermost, of an element; `made` counts components.
std::unique_ptr<Node> toNode(Element&& element, Node* parent, std::size_t& made) {
  auto node = std::make_unique<Node>();
  node->name = std::move(element.name);
  node->isNamed = element.isNamed;
  node->place = element.place;
  node->base = element.isOutermost ? element.place.file : parent->base;
  node->parent = parent;
  node->gravity = element.attributes.value("gravity");
  const auto activated = element.attributes.value("activated");
  const auto active = parseBool(activated);
  node->active = active.value_or(true);
  if (!active) node->badActivation = activated;
  const std::vector<std::string> names = allWords(element.attributes.value("depend"));
  for (std::size_t i = 0; i + 1 < names.size(); i += 2) node->order.emplace_back(names[i], names[i + 1]);
  for (auto& child : element.children) {
    if (child.isNode)
      node->children.push_back(toNode(std::move(child), node.get(), made));
    else
      addComponent(*node, std::move(child), made++);
  }
  return node;
}

}  // namespace

std::unique_ptr<Node> readSceneGraph(const std::filesystem::path& path, ReadScope& scope) {
  std::size_t made = 0;
  return toNode(ElementReader(scope).readFile(path), nullptr, made);
}

}  // namespace allpairs::scene::sofa
