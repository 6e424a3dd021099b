// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/elements/ElementCandidates.h"

namespace allpairs::app {

/// A kind of candidate, with its name in files and JSON, and for people.
struct KindName {
  elements::CandidateKind kind;
  std::string_view key;
  std::string_view title;
};

inline constexpr std::array<KindName, 3> kKindNames{{
    {elements::CandidateKind::VertexFace, "vertex_face", "vertex-face"},
    {elements::CandidateKind::EdgeEdge, "edge_edge", "edge-edge"},
    {elements::CandidateKind::FaceFace, "face_face", "face-face"},
}};

/// What `allpairs elements` found.
struct ElementReport {
  struct Mesh {
    std::string name;
    elements::ElementCounts counts;
  };

  /// A file that was written, and the key under which the report names it.
  struct File {
    std::string key;
    std::string path;
  };

  std::vector<Mesh> meshes;
  elements::ElementCounts counts;
  std::array<std::uint64_t, 3> candidates{};  ///< In the order of kKindNames.
  std::vector<File> files;
  double distance = 0.0;
  bool betweenOnly = false;
  std::size_t threads = 1;
  double readSeconds = 0.0;
  double findSeconds = 0.0;
};

[[nodiscard]] std::string tableOf(const ElementReport& report);
[[nodiscard]] std::string jsonOf(const ElementReport& report);

}  // namespace allpairs::app
