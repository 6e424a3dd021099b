// SPDX-License-Identifier: MIT
#include "detect/DetectWorlds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "allpairs/Worlds.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/scene/BoxFrames.h"
#include "allpairs/scene/FileError.h"
#include "cli/ExitStatus.h"
#include "cli/NpyOutput.h"
#include "cli/Progress.h"
#include "cli/Table.h"
#include "cli/Text.h"
#include "cli/TextParts.h"
#include "cli/Timer.h"
#include "input/Inputs.h"

namespace allpairs::app {
namespace {

/// The boxes of all worlds, one after the other.
struct WorldBoxes {
  std::size_t worlds = 0;
  std::size_t each = 0;
  std::vector<float> float32{};
  std::vector<double> float64{};

  [[nodiscard]] Worlds view() const {
    const BoxView boxes =
        float64.empty() ? BoxView::fromRows(std::span(float32)) : BoxView::fromRows(std::span(float64));
    return Worlds::ofEqualSize(boxes, worlds);
  }
};

WorldBoxes readWorlds(const InputSettings& input) {
  if (input.paths.size() != 1) throw UsageError("--worlds takes one input: a .npy file of shape (worlds, boxes, 6)");
  const std::string& path = input.paths.front();
  if (lowerExtension(path) != ".npy") throw UsageError("--worlds takes a .npy file of shape (worlds, boxes, 6)");
  refuseSceneOptions(input, "--worlds");
  scene::BoxFrames file(path, "world");
  WorldBoxes result{file.frameCount(), file.boxCount()};
  scene::EmptyBoxes empty;
  requireMemory(input, result.worlds * file.frameBytes());
  std::optional<ProgressClock> clock(std::in_place, "reading " + printable(path));
  for (std::size_t k = 0; k < result.worlds; ++k) {
    const BoxView boxes = file.next();
    empty.look(boxes, k * result.each);
    const std::size_t numbers = 6 * boxes.size();
    if (boxes.isFloat64()) {
      result.float64.reserve(result.worlds * numbers);
      result.float64.insert(result.float64.end(), boxes.float64().min.data, boxes.float64().min.data + numbers);
    } else if (numbers != 0) {
      result.float32.reserve(result.worlds * numbers);
      result.float32.insert(result.float32.end(), boxes.float32().min.data, boxes.float32().min.data + numbers);
    }
  }
  clock.reset();
  warnOfEmpty(input, empty, result.each, "world");
  return result;
}

/// Compares with an exhaustive search of each world alone.
void verify(const Worlds& worlds, const WorldPairsView& found, OverlapOptions options) {
  options.strategy = Strategy::Exhaustive;
  options.executor = nullptr;
  for (std::size_t k = 0; k < worlds.size(); ++k) {
    const std::vector<Pair> expected = overlaps(worlds[k], options);
    const std::span<const Pair> pairs = found[k];
    if (!std::equal(pairs.begin(), pairs.end(), expected.begin(), expected.end())) {
      throw collision::VerificationError(
          fmt::format("verification failed: the pairs of world {} are not those of an exhaustive search", k));
    }
  }
}

/// How the search went.
struct WorldsRun {
  double seconds = 0.0;
  bool isVerified = false;
};

template <class Use>
void forEachPair(const WorldPairsView& found, const Use& use) {
  for (std::size_t k = 0; k + 1 < found.begin.size(); ++k) {
    for (const Pair pair : found[k]) use(k, pair);
  }
}

void writeNpy(const WorldPairsView& found, Output& output) {
  if (found.begin.size() - 1 > std::uint64_t{0xFFFFFFFF}) throw UsageError("more worlds than 32 bits number");
  NpyOutput file(output, "<u4", {found.pairs.size(), 3});
  std::vector<std::uint32_t> rows;
  forEachPair(found, [&](std::size_t world, Pair pair) {
    rows.insert(rows.end(), {static_cast<std::uint32_t>(world), pair.first, pair.second});
    if (rows.size() < 3 * kBatchSize) return;
    file.add(rows);
    rows.clear();
  });
  file.add(rows);
}

void writeCsv(const WorldPairsView& found, Output& output) {
  TextParts text(output);
  text.add("world,first,second\n");
  forEachPair(found, [&](std::size_t world, Pair pair) { text.add("{},{},{}\n", world, pair.first, pair.second); });
  text.flush();
}

void writeJson(const WorldPairsView& found, const WorldBoxes& boxes, const WorldsRun& run, Output& output) {
  TextParts text(output);
  text.add("{{\"worlds\": {}, \"boxes\": {}, \"pairs\": [", boxes.worlds, boxes.each);
  const char* separator = "";
  forEachPair(found, [&](std::size_t world, Pair pair) {
    text.add("{}[{}, {}, {}]", separator, world, pair.first, pair.second);
    separator = ", ";
  });
  text.add("], \"statistics\": {{\"pairs\": {}, \"verified\": {}, \"detectSeconds\": {}}}}}\n", found.pairs.size(),
           run.isVerified, run.seconds);
  text.flush();
}

void writeTable(const WorldPairsView& found, const WorldBoxes& boxes, const WorldsRun& run, Output& output) {
  std::size_t most = 0;
  std::size_t without = 0;
  for (std::size_t k = 0; k < boxes.worlds; ++k) {
    if (found[k].size() > found[most].size()) most = k;
    without += found[k].empty() ? 1U : 0U;
  }
  std::string text = fmt::format("worlds   {} of {}\n", grouped(boxes.worlds), counted(boxes.each, "box", "boxes"));
  text += fmt::format("pairs    {}", grouped(found.pairs.size()));
  if (boxes.worlds != 0) {
    text +=
        fmt::format("; most in world {}, {}; none in {}", most, grouped(found[most].size()), counted(without, "world"));
  }
  text += '\n';
  if (run.isVerified) text += kVerifiedLine;
  text += fmt::format("time     {:.3f} ms\n\n--format csv, json or npy, or -o FILE, lists the pairs of each world.\n",
                      1000.0 * run.seconds);
  output.write(text);
}

}  // namespace

std::size_t detectWorlds(const InputSettings& input, const DetectionOptions& options, const std::string& format,
                         Output& output) {
  const WorldBoxes boxes = readWorlds(input);
  const Worlds worlds = boxes.view();
  const std::unique_ptr<Executor> executor = makeExecutor(options.threads, worlds.boxes().size());
  const OverlapOptions engine = overlapOptions(options, executor.get());
  WorldsSearch search(engine);
  const Timer timer;
  const WorldPairsView found = search.find(worlds);
  const WorldsRun run{timer.seconds(), options.verify};
  if (run.isVerified) verify(worlds, found, engine);
  if (format == "npy") {
    writeNpy(found, output);
  } else if (format == "csv") {
    writeCsv(found, output);
  } else if (format == "json") {
    writeJson(found, boxes, run, output);
  } else {
    writeTable(found, boxes, run, output);
  }
  return found.pairs.size();
}

}  // namespace allpairs::app
