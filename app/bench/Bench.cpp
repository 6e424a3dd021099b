// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "Commands.h"
#include "PairHash.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/EmptyBoxes.h"
#include "allpairs/scene/Scene.h"
#include "bench/BenchReport.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Text.h"
#include "cli/Warning.h"
#include "detect/Detection.h"
#include "generate/SceneArguments.h"

namespace allpairs::app {
namespace {

struct BenchSettings {
  SceneArguments scene;
  std::size_t threads = 1;
  std::size_t repetitions = 0;
  bool unordered = false;
  bool countOnly = false;
  std::string strategy = "auto";
  std::string instructionSet;
  bool json = false;
};

constexpr const char* kBenchExamples = R"(INPUT is a file of boxes (.npy or .csv), or one of these scenes:
)";

constexpr const char* kExplanation =
    R"(The time is that of one search from boxes in memory to pairs in memory by a new OverlapSearch
object; warm reuses the object of an earlier search. The hash is FNV-1a,
64 bits, over the pairs in the order (first, second), each two 32-bit little-endian
numbers: the same for every strategy, order, instruction set and number of threads.

Examples:
  allpairs bench boxes.npy
  allpairs bench uniform -n 1000000 --unordered --threads 2
  allpairs bench needles -n 50000 --count --json)";

/// Boxes to measure on: of a file, or made up.
struct Boxes {
  std::vector<float> rows;
  scene::BoxArray array;

  /// A new view, which checks all boxes again: that is part of the time.
  [[nodiscard]] BoxView view() const {
    if (array.size() == 0) return BoxView::fromRows(std::span<const float>(rows));
    const BoxView& boxes = array.boxes();
    if (boxes.isFloat64()) return BoxView::fromStrided(boxes.size(), boxes.float64().min, boxes.float64().max);
    return BoxView::fromStrided(boxes.size(), boxes.float32().min, boxes.float32().max);
  }
};

Boxes load(const BenchSettings& settings) {
  if (isSceneName(settings.scene.scene))
    return {.rows = generate::makeBoxes(sceneRequest(settings.scene)), .array = {}};
  Boxes boxes{.rows = {}, .array = scene::readBoxArray(settings.scene.scene)};
  for (const scene::Remark& warning : scene::boxWarnings(boxes.array, settings.scene.scene)) warn(textOf(warning));
  return boxes;
}

OverlapOptions overlapOptions(const BenchSettings& settings, Executor* executor) {
  OverlapOptions options;
  options.strategy = strategyOf(settings.strategy);
  options.order = settings.unordered ? Order::Unordered : Order::ByFirst;
  options.executor = executor;
  options.instructionSet = settings.instructionSet;
  return options;
}

/// Something to search with, again and again.
class Subject {
 public:
  Subject(const Boxes& boxes, OverlapOptions options, bool countOnly)
      : m_boxes(boxes), m_options(std::move(options)), m_countOnly(countOnly) {}

  /// Runs with an OverlapSearch of their own each; of a single one, taking it down is not part of the time.
  [[nodiscard]] measure::Duration oneShots(std::size_t runs) const {
    const measure::Stopwatch watch;
    for (std::size_t run = 1; run < runs; ++run) {
      OverlapSearch overlaps(m_options);
      search(overlaps);
    }
    OverlapSearch overlaps(m_options);
    search(overlaps);
    return watch.elapsed() / static_cast<double>(runs);
  }

  /// Runs that share one OverlapSearch, which has run before.
  [[nodiscard]] measure::Duration warmRuns(OverlapSearch& kept, std::size_t runs) const {
    const measure::Stopwatch watch;
    for (std::size_t run = 0; run < runs; ++run) search(kept);
    return watch.elapsed() / static_cast<double>(runs);
  }

  [[nodiscard]] const OverlapOptions& options() const { return m_options; }

 private:
  void search(OverlapSearch& overlaps) const {
    const BoxView boxes = m_boxes.view();
    if (m_countOnly) {
      (void)overlaps.count(boxes);
    } else {
      (void)overlaps.find(boxes);
    }
  }

  const Boxes& m_boxes;
  OverlapOptions m_options;
  bool m_countOnly;
};

measure::Effort effortOf(const BenchSettings& settings) {
  measure::Effort effort;
  effort.fewestSamples = settings.repetitions == 0 ? 5 : settings.repetitions;
  effort.mostSamples = settings.repetitions == 0 ? 200 : settings.repetitions;
  return effort;
}

measure::Summary measureRuns(measure::TimedRuns timedRuns, const measure::Effort& effort) {
  measure::Sampling sampling(std::move(timedRuns), effort);
  for (std::size_t sample = 0; sample < sampling.allowance(); ++sample) sampling.take();
  return sampling.summary();
}

/// How many pairs there are, what it took to find them, and unless they are only counted, their hash.
void takeResult(const Boxes& boxes, OverlapSearch& overlaps, bool countOnly, BenchRecord& record) {
  if (countOnly) {
    record.pairs = overlaps.count(boxes.view());
  } else {
    const std::vector<Pair> pairs = measure::normalised(overlaps.find(boxes.view()));
    record.pairs = pairs.size();
    record.hash = measure::hexadecimal(measure::hashOfPairs(pairs));
  }
  record.work = overlaps.statistics();
}

std::string orderName(const BenchSettings& settings) {
  if (settings.countOnly) return "count";
  return settings.unordered ? "unordered" : "ordered";
}

BenchRecord measureBoxes(const Boxes& boxes, const BenchSettings& settings, Executor* executor) {
  BenchRecord record{.input = settings.scene.scene,
                     .boxes = boxes.view().size(),
                     .order = orderName(settings),
                     .strategy = settings.strategy,
                     .threads = settings.threads,
                     .provenance = measure::provenance()};
  const std::string_view best = instructionSets().front();
  record.instructionSet = settings.instructionSet.empty() ? std::string(best) : settings.instructionSet;
  const Subject subject(boxes, overlapOptions(settings, executor), settings.countOnly);
  OverlapSearch kept(subject.options());
  takeResult(boxes, kept, settings.countOnly, record);
  const measure::Effort effort = effortOf(settings);
  record.oneShot = measureRuns([&](std::size_t runs) { return subject.oneShots(runs); }, effort);
  record.warm = measureRuns([&](std::size_t runs) { return subject.warmRuns(kept, runs); }, effort);
  return record;
}

void runBench(const BenchSettings& settings) {
  constexpr std::size_t kMostThreads = 9999;
  if (settings.threads == 0 || settings.threads > kMostThreads)
    throw UsageError(
        fmt::format("--threads: {} is not a number of threads from 1 to {}", settings.threads, kMostThreads));
  const auto sets = instructionSets();
  const std::string& wanted = settings.instructionSet;
  if (!wanted.empty() && std::find(sets.begin(), sets.end(), wanted) == sets.end()) {
    throw UsageError(fmt::format("--instruction-set: '{}' is not available on this processor, which has {}", wanted,
                                 fmt::join(sets, ", ")));
  }
  const Boxes boxes = load(settings);
  std::optional<parallel::TbbExecutor> executor;
  if (settings.threads > 1) executor.emplace(settings.threads);
  const BenchRecord record = measureBoxes(boxes, settings, executor ? &*executor : nullptr);
  Output(std::nullopt).write(settings.json ? benchJson(record) : benchTable(record));
}

void addSearchOptions(CLI::App& command, BenchSettings& settings) {
  takeCount(
      *command.add_option("--threads", settings.threads, "Number of threads")->type_name("N")->capture_default_str());
  takeCount(*command.add_option("--repetitions", settings.repetitions, "Number of repetitions; 0: for about a second")
                 ->type_name("R")
                 ->capture_default_str());
  CLI::Option* unordered = command.add_flag("--unordered", settings.unordered, "Pairs in the order of discovery");
  command.add_flag("--count", settings.countOnly, "Count the pairs only")->excludes(unordered);
  addStrategy(command, settings.strategy);
  command.add_option("--instruction-set", settings.instructionSet, "Instruction set; default: the processor's best")
      ->type_name("NAME");
  command.add_flag("--json", settings.json, "Print one JSON object instead of a table");
}

/// A file has the boxes that it has.
void checkSceneOptions(const CLI::App& command, const BenchSettings& settings) {
  const std::string& name = settings.scene.scene;
  if (isSceneName(name)) return;
  std::error_code ignored;
  if (lowerExtension(name).empty() && !std::filesystem::exists(name, ignored))
    throw UsageError("'" + name + "' is neither a file nor the name of a scene");
  for (const char* const option : {"--boxes", "--seed", "--sorted"}) {
    if (command.count(option) == 0) continue;
    throw UsageError(std::string(option) + " is for a scene that is made up, not for '" + name + "'");
  }
}

}  // namespace

void addBench(CLI::App& program) {
  const auto settings = std::make_shared<BenchSettings>();
  CLI::App* command = program.add_subcommand("bench", "Measure the time of a search");
  command->footer(kBenchExamples + sceneList() + "\n\n" + kExplanation);
  command->add_option("INPUT", settings->scene.scene, "A file of boxes, or the name of a scene")
      ->required()
      ->type_name("");
  addSceneOptions(*command, settings->scene);
  addSearchOptions(*command, *settings);
  command->callback([settings, command] {
    checkSceneOptions(*command, *settings);
    runBench(*settings);
  });
}

}  // namespace allpairs::app
