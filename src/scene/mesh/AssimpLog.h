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
/// Reference: Assimp 5.2, LogWarn() and LogError() in IFCGeometry, IFCProfile, IFCCurve and IFCBoolean; OpcPackage in
/// D3MFOpcPackage.
class AssimpLog final : public Assimp::Logger {
 public:
  /// Makes one that Assimp writes to, and owns, until this is called again.
  [[nodiscard]] static const AssimpLog& start();

  /// The kinds of an IFC's bodies that are missing, as IfcCsgSolid.
  [[nodiscard]] const std::set<std::string>& missingKinds() const { return m_missing; }

  /// How many parts with models a 3MF has; the objects of the first alone are read.
  [[nodiscard]] std::size_t parts() const { return m_parts; }

  bool attachStream(Assimp::LogStream* /*stream*/, unsigned int /*severity*/) override { return false; }
  bool detachStream(Assimp::LogStream* /*stream*/, unsigned int /*severity*/) override { return false; }

 private:
  AssimpLog() = default;

  void OnDebug(const char* /*message*/) override {}         // NOLINT: Assimp's name, as those below
  void OnVerboseDebug(const char* /*message*/) override {}  // NOLINT
  void OnInfo(const char* /*message*/) override {}          // NOLINT
  void OnWarn(const char* message) override;                // NOLINT
  void OnError(const char* message) override;               // NOLINT
  void note(std::string_view message);

  std::set<std::string> m_missing;
  std::size_t m_parts = 0;
};

}  // namespace allpairs::scene
