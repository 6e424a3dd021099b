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
/// Reference: Assimp 5.2, LogWarn() and LogError() in IFCGeometry, IFCProfile, IFCCurve and IFCBoolean; D3MFOpcPackage;
/// skippedNode() in X3DImporter.
class AssimpLog final : public Assimp::Logger {
 public:
  /// Makes one that Assimp writes to, and owns, until this is called again.
  [[nodiscard]] static const AssimpLog& start();

  /// The kinds of an IFC's bodies that are missing, as IfcCsgSolid.
  [[nodiscard]] const std::set<std::string>& missingKinds() const { return m_missing; }

  /// The kinds of an X3D's nodes that hold shapes and are missing, as LOD.
  [[nodiscard]] const std::set<std::string>& missingNodes() const { return m_missingNodes; }

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
  std::set<std::string> m_missingNodes;
  std::size_t m_parts = 0;
};

}  // namespace allpairs::scene
