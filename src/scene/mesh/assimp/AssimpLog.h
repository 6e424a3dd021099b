// SPDX-License-Identifier: MIT
#pragma once

#include <assimp/Logger.hpp>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>

namespace allpairs::scene {

/// What Assimp says while it reads, of which its result tells nothing: that it leaves out shapes.
///
/// Reference: Assimp 5.2, LogWarn() and LogError() in IFCLoader, IFCGeometry, IFCProfile, IFCCurve and IFCBoolean;
/// D3MFOpcPackage; skippedNode() in X3DImporter.
class AssimpLog final : public Assimp::Logger {
 public:
  /// Makes one that Assimp writes to, and owns, until this is called again.
  [[nodiscard]] static const AssimpLog& start();

  /// The kinds of an IFC's bodies that are missing, as IfcCsgSolid.
  [[nodiscard]] const std::set<std::string>& missingKinds() const { return m_missing; }

  /// The kinds of an IFC's places that are not read, so that products are elsewhere.
  [[nodiscard]] const std::set<std::string>& unknownPlacements() const { return m_unknownPlacements; }

  /// The kinds of an X3D's nodes that are not read, be they of shapes or not.
  [[nodiscard]] const std::set<std::string>& skippedNodes() const { return m_skippedNodes; }

  /// How many parts with models a 3MF has; the objects of the first alone are read.
  [[nodiscard]] std::size_t parts() const { return m_parts; }

  bool attachStream(Assimp::LogStream* /*stream*/, unsigned int /*severity*/) override { return false; }
  bool detachStream(Assimp::LogStream* /*stream*/, unsigned int /*severity*/) override { return false; }

 private:
  AssimpLog() = default;

  void OnDebug(const char* /*message*/) override {}         // NOLINT: Assimp's name, as those below
  void OnVerboseDebug(const char* /*message*/) override {}  // NOLINT
  void OnInfo(const char* message) override;                // NOLINT
  void OnWarn(const char* message) override;                // NOLINT
  void OnError(const char* message) override;               // NOLINT
  void note(std::string_view message);

  std::set<std::string> m_missing;
  std::set<std::string> m_unknownPlacements;
  std::set<std::string> m_skippedNodes;
  std::size_t m_parts = 0;
};

}  // namespace allpairs::scene
