// SPDX-License-Identifier: MIT
#include "track/FrameSource.h"

#include <algorithm>
#include <array>
#include <utility>

#include "allpairs/scene/BoxFrames.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Text.h"
#include "input/MeshSteps.h"

namespace allpairs::app {
namespace {

class NpyFrames final : public FrameSource {
 public:
  explicit NpyFrames(const std::string& path) : m_frames(path) {}

  [[nodiscard]] std::size_t frameCount() const override { return m_frames.frameCount(); }
  [[nodiscard]] BoxView next() override { return m_frames.next(); }

 private:
  scene::BoxFrames m_frames;
};

class MeshFrames final : public FrameSource {
 public:
  MeshFrames(std::vector<std::string> paths, scene::ReadOptions options)
      : m_paths(std::move(paths)), m_options(std::move(options)) {}

  [[nodiscard]] std::size_t frameCount() const override { return m_paths.size(); }

  [[nodiscard]] BoxView next() override {
    std::vector<TriangleMesh> meshes = readTriangleMeshes(m_paths[m_frame], m_options);
    if (m_frame == 0) m_first = meshes;
    checkSameMeshes(m_first, m_paths.front(), meshes, m_paths[m_frame]);
    ++m_frame;
    m_boxes.clear();
    for (const TriangleMesh& mesh : meshes) addBoxes(mesh);
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
  void addBoxes(const TriangleMesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      Box box = kEmptyBox;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const double* point = &mesh.positions[3 * std::size_t{mesh.triangles[i + corner]}];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box.min[axis] = std::min(box.min[axis], point[axis]);
          box.max[axis] = std::max(box.max[axis], point[axis]);
        }
      }
      m_boxes.push_back(box);
    }
  }

  std::vector<std::string> m_paths;
  scene::ReadOptions m_options;
  std::size_t m_frame = 0;
  std::vector<TriangleMesh> m_first;
  std::vector<Box> m_boxes;
};

}  // namespace

std::unique_ptr<FrameSource> openFrames(const std::vector<std::string>& paths, const scene::ReadOptions& options) {
  const auto isNpy = [](const std::string& path) { return lowerExtension(path) == ".npy"; };
  if (std::none_of(paths.begin(), paths.end(), isNpy)) return std::make_unique<MeshFrames>(paths, options);
  if (paths.size() == 1) return std::make_unique<NpyFrames>(paths.front());
  throw UsageError("give one .npy file with all frames, or one mesh file per frame");
}

}  // namespace allpairs::app
