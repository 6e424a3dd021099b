// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "BufferProtocol.h"
#include "Interrupts.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/Scene.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::python {

/// How the pairs of a scene are looked for.
struct DetectionOptions {
  std::optional<double> distance;  ///< In place of the scene's alarm distance.
  std::optional<Box> region;       ///< In place of the scene's.
  Strategy strategy = Strategy::Automatic;
  std::size_t threads = 1;
  bool verify = false;
};

/// What a file or a folder holds: collision models and how they are tested, or boxes in one block of memory.
///
/// Threads: detections of one scene wait for each other.
class LoadedScene {
 public:
  LoadedScene(const std::filesystem::path& path, const scene::ReadOptions& options);

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] scene::ModelRecord model(std::size_t index) const;
  [[nodiscard]] std::span<const scene::Remark> remarks() const { return m_scene.remarks; }
  [[nodiscard]] std::span<const scene::Remark> warnings() const { return m_scene.warnings; }

  /// How models are tested, how far apart they may be, and where.
  [[nodiscard]] std::string_view method() const { return m_scene.intersection->typeName(); }
  [[nodiscard]] double alarmDistance() const { return m_scene.intersection->getAlarmDistance(); }
  [[nodiscard]] std::optional<Box> region() const { return m_scene.region; }

  /// An array of shape (n, 6): float32 or float64 where a file of boxes has it so, which stays where it is; root boxes
  /// are float64, for as long as the scene lives.
  [[nodiscard]] Table& table() { return m_boxes; }

  /// The pairs that may touch, newest model first, in the order of the double loop.
  [[nodiscard]] std::vector<Pair> detect(const DetectionOptions& options, Stopper& stopper);

 private:
  [[nodiscard]] Table boxes();

  scene::Scene m_scene = scene::emptyScene();   ///< Stays empty where a file has boxes.
  std::optional<scene::BoxArray> m_boxArray{};  ///< Of a file of boxes.
  std::vector<double> m_rootBoxes;
  Table m_boxes;
  std::mutex m_mutex;
  CallFlag m_stop;
};

}  // namespace allpairs::python
