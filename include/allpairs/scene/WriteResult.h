// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/Pair.h"
#include "allpairs/Span.h"
#include "allpairs/collision/CollisionModel.h"
#include "allpairs/scene/Scene.h"

namespace allpairs::scene {

/// The record of one model in a result.
struct ModelRecord {
  std::string name;
  std::string file{};  ///< What it was read from; empty where that is not known.
  std::string kind{};  ///< As of ModelSource, and so are the next two.
  std::string id{};
  std::string path{};
  std::string type;
  std::size_t elements = 0;
  Box box = kEmptyBox;  ///< Of the root; empty without elements.
  bool active = true;
  bool simulated = true;
  bool moving = true;
  bool selfCollision = false;
  std::vector<int> groups{};
  double contactDistance = 0.0;
  std::optional<bool> outside{};  ///< Whether it lies outside of its region, and is in no pair; nothing if not asked.
};

/// The record of a model whose bounding tree was computed.
[[nodiscard]] ModelRecord modelRecord(const collision::CollisionModel& model);

/// The record of a scene's model, with the file that it comes from.
[[nodiscard]] ModelRecord modelRecord(const Scene& scene, std::size_t model);

/// Statistics of a detection: the last part of a result.
struct DetectionStatistics {
  std::string strategy{};             ///< As the caller chose it: auto, exhaustive, bvh.
  std::size_t threads = 1;            ///< The number of threads it could use.
  double distance = 0.0;              ///< The gap allowed between two boxes, or the alarm distance.
  std::uint64_t testsOfAllPairs = 0;  ///< The number of tests of a double loop over the models.
  std::uint64_t testsMade = 0;        ///< The number of tests made, of two boxes or of the bounds of two groups.
  std::uint64_t candidates =
      0;  ///< The number of pairs of models whose flags and groups were tested, after their boxes.
  double readSeconds = 0.0;
  double detectSeconds = 0.0;
  bool verified = false;  ///< Whether the exhaustive strategy was run too, and agreed.
};

/// The record of one of several pipelines in a result.
struct PipelineRecord {
  std::string name{};
  std::string method{};
  double distance = 0.0;              ///< The alarm distance.
  std::optional<Box> region{};        ///< Models outside of it are in no pair of this pipeline.
  std::vector<std::size_t> models{};  ///< Indices, in the order in which the pipeline takes them.
  std::size_t pairs = 0;              ///< The number of its pairs; those of the first pipeline come first.
};

/// Models, pairs of them by index, and statistics. Pairs, remarks and pipelines are not owned.
struct ResultView {
  std::size_t modelCount = 0;
  std::function<ModelRecord(std::size_t)> model{};
  Span<const Pair> pairs{};
  Span<const Remark> ignored{};  ///< The parts of the input that were skipped.
  Span<const Remark> warnings{};
  Span<const PipelineRecord> pipelines{};  ///< Where the input has several.
  bool swapped = false;                    ///< Write each pair's second before its first.
  DetectionStatistics statistics{};
};

/// What an input holds: models, what they have together, and how they are tested. Remarks and pipelines are not owned.
struct InputView {
  std::size_t modelCount = 0;
  std::function<ModelRecord(std::size_t)> model{};
  std::size_t elements = 0;  ///< Of all models.
  Box box = kEmptyBox;       ///< Around all models.
  std::string method{};
  double distance = 0.0;         ///< The alarm distance.
  std::optional<Box> region{};   ///< Models outside of it are in no pair.
  Span<const Remark> ignored{};  ///< The parts of the input that were skipped.
  Span<const Remark> warnings{};
  Span<const PipelineRecord> pipelines{};  ///< Where the input has several; their pairs are not known.
};

/// Receives a result's bytes, in chunks.
using ByteSink = FunctionRef<void(std::string_view)>;

/// Writes {"models": [...], "pairs": [[i, j], ...], "ignored": [...], "warnings": [...], "statistics": {...}}, and
/// "pipelines": [...] before the statistics where there are several.
///
/// A number is written with enough digits to read the same number again. JSON has no infinities: they are
/// the strings "inf" and "-inf".
/// Cost: linear, in constant memory.
void writeJson(const ResultView& result, ByteSink sink);

/// Writes {"models": [...], "ignored": [...], "warnings": [...], "statistics": {...}}, and "pipelines": [...] as above.
/// Cost: linear, in constant memory.
void writeInputJson(const InputView& input, ByteSink sink);

/// Writes a header, and a line with the two names for each pair; names are quoted where they need to be (RFC 4180).
void writeCsv(const ResultView& result, ByteSink sink);

/// A name as a field of CSV: quoted where it needs to be (RFC 4180).
[[nodiscard]] std::string csvField(const std::string& name);

/// What stands before the numbers of a .npy file (format 1.0) that holds an array in C order; they begin at a multiple
/// of 64 bytes. `type` is theirs as NumPy names it: "<u4", "<f8".
[[nodiscard]] std::string npyHeader(std::string_view type, Span<const std::uint64_t> shape);

/// Writes the pairs as a NumPy array of shape (m, 2), uint32, little-endian.
void writeNpy(const ResultView& result, ByteSink sink);

}  // namespace allpairs::scene
