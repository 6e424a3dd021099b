// SPDX-License-Identifier: MIT
#include "view/ViewFrames.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "Explain.h"
#include "PageSize.h"
#include "allpairs/Overlaps.h"
#include "allpairs/scene/BoxFrames.h"
#include "allpairs/scene/FileError.h"
#include "cli/ExitStatus.h"
#include "cli/Progress.h"
#include "cli/Text.h"
#include "cli/Timer.h"
#include "input/Inputs.h"
#include "input/MeshSteps.h"
#include "view/ViewBoxes.h"

namespace allpairs::app {
namespace {

/// Looks for the pairs of one frame after another.
class FrameSearch {
 public:
  FrameSearch(view::ViewScene& scene, const DetectionOptions& options, std::size_t frames)
      : m_scene(scene), m_options(options), m_frames(frames), m_executor(makeExecutor(options.threads, count())) {
    OverlapOptions searchOptions = overlapOptions(options, m_executor.get());
    searchOptions.order = Order::BySecond;
    if (!scene.corners.empty()) {
      searchOptions.filter.accept = [&scene](std::uint32_t a, std::uint32_t b) {
        return !view::shareVertex(scene, a, b);
      };
    }
    m_search.setOptions(std::move(searchOptions));
    m_scene.statistics.strategy = strategyName(options.strategy);
    m_scene.statistics.distance = scene.distance;
  }

  /// Adds a frame of boxes, and of a sequence of meshes where the vertices are: its pairs newest first, as a scene's.
  void add(const BoxView& boxes, std::vector<double> positions = {}) {
    const Timer timer;
    view::ViewFrame frame = boxFrame(boxes, m_options);
    frame.positions = std::move(positions);
    for (const auto& [first, second] : m_search.find(boxes)) frame.pairs.push_back({second, first});
    noteChanges(frame);
    const std::uint64_t n = count();
    m_scene.statistics.testsOfAllPairs += n == 0 ? 0 : n * (n - 1) / 2;
    m_scene.statistics.testsMade += m_search.statistics().boxTests + m_search.statistics().groupTests;
    m_scene.statistics.detectSeconds += timer.seconds();
    m_pairs += frame.pairs.size();
    view::checkPageSize(m_scene, m_frames, m_frames * view::bytesOf(frame, 0) + m_pairs * sizeof(Pair));
    m_scene.frames.push_back(std::move(frame));
  }

 private:
  [[nodiscard]] std::size_t count() const { return m_scene.modelCount; }

  /// Counts the pairs that one of two frames has and the other has not, as `track` does; both are ordered by their
  /// newer box.
  void noteChanges(view::ViewFrame& frame) const {
    if (m_scene.frames.empty()) {
      frame.began = frame.pairs.size();
      return;
    }
    const std::vector<Pair>& before = m_scene.frames.back().pairs;
    std::size_t kept = 0;
    auto was = before.begin();
    for (const Pair& pair : frame.pairs) {
      while (was != before.end() && *was < pair) ++was;
      if (was != before.end() && *was == pair) ++kept;
    }
    frame.began = frame.pairs.size() - kept;
    frame.ended = before.size() - kept;
  }

  view::ViewScene& m_scene;
  const DetectionOptions& m_options;
  std::size_t m_frames;
  std::size_t m_pairs = 0;
  std::unique_ptr<Executor> m_executor;
  OverlapSearch m_search;
};

view::ViewScene emptyScene(const InputSettings& input, const DetectionOptions& options, std::size_t frames) {
  view::ViewScene scene;
  scene.title = titleOf(input);
  scene.method = fmt::format("{}, {}", boxMethod(options.distance, options.region), counted(frames, "frame"));
  scene.distance = options.distance.value_or(0.0);
  scene.region = options.region;
  return scene;
}

view::ViewScene makeBoxFrames(const InputSettings& input, const DetectionOptions& options) {
  const Timer timer;
  scene::BoxFrames frames(input.paths.front());
  if (frames.frameCount() == 0) throw FileError(input.paths.front(), "holds no frames: there is nothing to show");
  const std::uint64_t kept = std::uint64_t{frames.frameCount()} * frames.boxCount() * sizeof(Box);
  requireMemory(input, frames.frameBytes() + kept);
  view::ViewScene scene = emptyScene(input, options, frames.frameCount());
  addBoxColumns(frames.boxCount(), scene);
  FrameSearch search(scene, options, frames.frameCount());
  scene::EmptyBoxes empty;
  ProgressLine line;
  for (std::size_t i = 0; i < frames.frameCount(); ++i) {
    line.show(i, frames.frameCount(), fmt::format("frame {} of {}", grouped(i + 1), grouped(frames.frameCount())));
    const BoxView boxes = frames.next();
    empty.look(boxes, i * frames.boxCount());
    search.add(boxes);
  }
  line.clear();
  warnOfEmpty(input, empty, frames.boxCount(), "frame");
  scene.statistics.readSeconds = timer.seconds() - scene.statistics.detectSeconds;
  return scene;
}

/// The columns of the triangles of all meshes; each is called by its number, and where there are several by its mesh.
void addTriangles(const std::vector<TriangleMesh>& meshes, view::ViewScene& to) {
  std::size_t firstVertex = 0;
  for (const TriangleMesh& mesh : meshes) {
    for (const std::uint32_t corner : mesh.triangles) {
      to.corners.push_back(static_cast<std::uint32_t>(firstVertex + corner));
    }
    const std::string prefix = meshes.size() > 1 ? mesh.name + ": " : "";
    for (std::size_t i = 0; i < mesh.triangles.size() / 3; ++i)
      to.names.push_back(prefix + fmt::format("triangle {}", i));
    firstVertex += mesh.positions.size() / 3;
  }
  addBoxColumns(to.corners.size() / 3, to);
  to.typeNames = {"Triangle"};
  to.method += "; triangles that share a vertex are never paired";
}

std::vector<double> positionsOf(const std::vector<TriangleMesh>& meshes) {
  std::vector<double> all;
  for (const TriangleMesh& mesh : meshes) all.insert(all.end(), mesh.positions.begin(), mesh.positions.end());
  return all;
}

view::ViewScene makeMeshFrames(const InputSettings& input, const DetectionOptions& options) {
  const Timer timer;
  const std::vector<std::string>& paths = input.paths;
  view::ViewScene scene = emptyScene(input, options, paths.size());
  const std::vector<TriangleMesh> first = readTriangleMeshes(input, 0, true);
  addTriangles(first, scene);
  FrameSearch search(scene, options, paths.size());
  ProgressLine line;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string name = printable(std::filesystem::path(paths[i]).filename().string());
    line.show(i, paths.size(), fmt::format("frame {} of {}: {}", i + 1, paths.size(), name));
    const std::vector<TriangleMesh> meshes = i == 0 ? first : readTriangleMeshes(input, i, false);
    checkSameMeshes(first, paths.front(), meshes, paths[i]);
    const std::vector<Box> boxes = triangleBoxes(meshes);
    search.add(BoxView::fromBoxes(boxes), positionsOf(meshes));
  }
  scene.statistics.readSeconds = timer.seconds() - scene.statistics.detectSeconds;
  return scene;
}

}  // namespace

bool isAnyBoxFrames(const std::vector<std::string>& paths) {
  return std::any_of(paths.begin(), paths.end(), [](const std::string& path) { return scene::isBoxFramesFile(path); });
}

view::ViewScene makeViewFrames(const InputSettings& input, const ViewRequest& request) {
  const bool isArray = isAnyBoxFrames(input.paths);
  if (isArray && input.paths.size() > 1) throw UsageError("an array of frames must be the only input");
  const std::string to = isArray ? "an array of frames" : "--sequence";
  refuseSceneOptions(input, to);
  const bool isGrouped = request.grouping == Grouping::Assembly || request.grouping == Grouping::File;
  if (isGrouped) throw UsageError("--group does not apply to " + to);
  refuseScenesAsFrames(input);
  if (request.shapes == ShapeTest::Always)
    throw UsageError("--exact, --clearance and --min-depth do not apply to " + to);
  view::ViewScene scene = isArray ? makeBoxFrames(input, request.detection) : makeMeshFrames(input, request.detection);
  scene.up = request.up.value_or(scene.up);
  return scene;
}

}  // namespace allpairs::app
