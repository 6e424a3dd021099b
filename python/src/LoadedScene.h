// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <variant>
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
  [[nodiscard]] std::span<const scene::Remark> remarks() const;
  [[nodiscard]] std::span<const scene::Remark> warnings() const;

  /// Where the scene names them: how its models are tested, how far apart they may be, and where.
  [[nodiscard]] std::string method() const;
  [[nodiscard]] double alarmDistance() const;
  [[nodiscard]] std::optional<Box> region() const;

  /// An array of shape (n, 6): float32 or float64 where a file of boxes has it so, which stays where it is; root boxes
  /// are float64, for as long as the scene lives.
  [[nodiscard]] Table& table() { return m_boxes; }

  /// The pairs that may touch, newest model first, in the order of the double loop.
  [[nodiscard]] std::vector<Pair> detect(const DetectionOptions& options, Stopper& stopper);

 private:
  [[nodiscard]] Table boxes();

  std::variant<scene::Scene, scene::BoxArray> m_content;
  std::vector<double> m_rootBoxes;
  Table m_boxes;
  std::mutex m_mutex;
  CallFlag m_stop;
};

}  // namespace allpairs::python
