// SPDX-License-Identifier: MIT
#include "track/FrameSource.h"

#include <algorithm>
#include <array>
#include <utility>

#include "allpairs/scene/BoxFrames.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Text.h"
#include "input/Inputs.h"
#include "input/MeshSteps.h"

namespace allpairs::app {
namespace {

class NpyFrames final : public FrameSource {
 public:
  explicit NpyFrames(const InputSettings& input) : m_frames(input.paths.front()) {
    requireMemory(input, m_frames.frameBytes());
  }

  [[nodiscard]] std::size_t frameCount() const override { return m_frames.frameCount(); }
  [[nodiscard]] std::size_t boxCount() const override { return m_frames.boxCount(); }
  [[nodiscard]] BoxView next() override { return m_frames.next(); }

 private:
  scene::BoxFrames m_frames;
};

class MeshFrames final : public FrameSource {
 public:
  explicit MeshFrames(const InputSettings& input) : m_input(input) {}

  [[nodiscard]] std::size_t frameCount() const override { return m_input.paths.size(); }

  [[nodiscard]] BoxView next() override {
    std::vector<TriangleMesh> meshes = readTriangleMeshes(m_input, m_frame, m_frame == 0);
    if (m_frame == 0) m_first = meshes;
    checkSameMeshes(m_first, m_input.paths.front(), meshes, m_input.paths[m_frame]);
    ++m_frame;
    m_boxes = triangleBoxes(meshes);
    return BoxView::fromBoxes(m_boxes);
  }

  [[nodiscard]] PairPredicate accept() const override {
    std::vector<std::array<std::size_t, 3>> corners;
    std::size_t first = 0;
    for (const TriangleMesh& mesh : m_first) {
      for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        corners.push_back({first + mesh.triangles[i], first + mesh.triangles[i + 1], first + mesh.triangles[i + 2]});
      }
      first += mesh.positions.size() / 3;
    }
    return [corners = std::move(corners)](std::uint32_t a, std::uint32_t b) {
      return std::find_first_of(corners[a].begin(), corners[a].end(), corners[b].begin(), corners[b].end()) ==
             corners[a].end();
    };
  }

 private:
  const InputSettings& m_input;
  std::size_t m_frame = 0;
  std::vector<TriangleMesh> m_first;
  std::vector<Box> m_boxes;
};

}  // namespace

std::unique_ptr<FrameSource> openFrames(const InputSettings& input) {
  const std::vector<std::string>& paths = input.paths;
  const auto isNpy = [](const std::string& path) { return lowerExtension(path) == ".npy"; };
  refuseScenesAsFrames(input);
  if (std::none_of(paths.begin(), paths.end(), isNpy)) return std::make_unique<MeshFrames>(input);
  if (paths.size() == 1) return std::make_unique<NpyFrames>(input);
  throw UsageError("give one .npy file with all frames, or one mesh file per frame");
}

}  // namespace allpairs::app
