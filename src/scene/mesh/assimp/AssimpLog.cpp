// SPDX-License-Identifier: MIT
#include "mesh/assimp/AssimpLog.h"

#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>

#include "input/Words.h"

namespace allpairs::scene {
namespace {

/// Whether items of an IFC's representation are lines, points or texts: without them no body is missing.
bool isNoBody(std::string_view kind) {
  static constexpr std::array<std::string_view, 7> kParts{"Curve",   "Polyline", "Annotation", "TextLiteral",
                                                          "Ellipse", "Circle",   "LightSource"};
  return isOneOf(kind, {"IfcLine", "IfcGeometricSet", "IfcDefinedSymbol", "IfcPoint", "IfcCartesianPoint",
                        "IfcPlacement", "IfcVector", "IfcDirection", "IfcPlanarExtent"}) ||
         std::any_of(kParts.begin(), kParts.end(),
                     [kind](std::string_view part) { return kind.find(part) != std::string_view::npos; });
}

/// Whether it is a point, an edge or a face of an IFC's topology, as of a structural analysis.
bool isTopology(std::string_view kind) {
  static constexpr std::array<std::string_view, 4> kParts{"IfcVertex", "IfcEdge", "IfcFaceSurface", "IfcPath"};
  return isOneOf(kind, {"IfcOrientedEdge", "IfcSubedge", "IfcFace"}) ||
         std::any_of(kParts.begin(), kParts.end(), [kind](std::string_view part) { return kind.starts_with(part); });
}

/// Whether a message names a part with a model of a 3MF, and not what macOS adds to archives.
bool isPartOf3mf(std::string_view message) {
  constexpr std::string_view kIgnored = "Ignored file of unknown type: ";
  return message.starts_with(kIgnored) && !message.substr(kIgnored.size()).starts_with("__MACOSX/") &&
         lowerCase(message).ends_with(".model");
}

/// The word behind a text; empty where the text is not there.
std::string_view wordBehind(std::string_view message, std::string_view text) {
  const std::size_t at = message.find(text);
  if (at == std::string_view::npos) return {};
  std::string_view rest = message.substr(at + text.size());
  return takeWord(rest);
}

}  // namespace

const AssimpLog& AssimpLog::start() {
  auto* const log = new AssimpLog;  // NOLINT(cppcoreguidelines-owning-memory): Assimp owns it
  Assimp::DefaultLogger::set(log);
  return *log;
}

void AssimpLog::OnInfo(const char* message) {
  constexpr std::string_view kSkipping = "Skipping node \"";
  const std::string_view text = message;
  if (!text.starts_with(kSkipping)) return;
  std::string_view node = text.substr(kSkipping.size());
  node = node.substr(0, node.find('"'));
  m_skippedNodes.emplace(node);
}

void AssimpLog::OnWarn(const char* message) { note(message); }
void AssimpLog::OnError(const char* message) { note(message); }

void AssimpLog::note(std::string_view message) {
  if (isPartOf3mf(message)) ++m_parts;
  if (!message.starts_with("IFC: ")) return;
  const std::string_view kind = wordBehind(message, "type is ");
  const std::string_view what = wordBehind(message, "skipping unknown ");
  const bool isBodiless = what == "IfcGeometricRepresentationItem" && (isNoBody(kind) || isTopology(kind));
  if (what == "IfcObjectPlacement") {
    m_unknownPlacements.emplace(kind);
  } else if (!kind.empty() && !isBodiless) {
    m_missing.emplace(kind);
  }
  const std::string_view operation = wordBehind(message, "unsupported boolean operator: ");
  if (!operation.empty()) m_missing.insert("IfcBooleanResult of " + lowerCase(operation));
  if (message.ends_with("(IfcSweptDiskSolid)")) m_missing.emplace("IfcSweptDiskSolid");
}

}  // namespace allpairs::scene
