// SPDX-License-Identifier: MIT
#include "MakeViewScene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "ExitStatus.h"
#include "Explain.h"
#include "ModelMesh.h"
#include "Records.h"
#include "Timer.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/scene/BoxFrames.h"

namespace allpairs::app {
namespace {

using collision::CollisionModel;
namespace flag = view::flag;

/// Numbers things by the order in which they first come.
template <class Key>
class Numbering {
 public:
  std::uint32_t numberOf(const Key& key) {
    const auto [place, isNew] = m_numbers.emplace(key, static_cast<std::uint32_t>(m_keys.size()));
    if (isNew) m_keys.push_back(key);
    return place->second;
  }

  [[nodiscard]] const std::vector<Key>& keys() const { return m_keys; }

 private:
  std::map<Key, std::uint32_t> m_numbers;
  std::vector<Key> m_keys;
};

/// Asks the broad phase about one model, as it does itself when the model is added.
class ModelProbe : public collision::BruteForceBroadPhase {
 public:
  explicit ModelProbe(const scene::Scene& scene) {
    setIntersectionMethod(scene.intersection.get());
    if (scene.region) setBox(*scene.region);
    init();
  }

  std::uint8_t flagsOf(CollisionModel& model) {
    std::uint8_t flags = 0;
    if (model.isActive()) flags |= flag::kActive;
    if (model.isSimulated()) flags |= flag::kSimulated;
    if (model.isMoving()) flags |= flag::kMoving;
    if (model.getSelfCollision()) flags |= flag::kSelfCollision;
    if (model.getLast()->empty()) return flags | flag::kNoElements;
    if (getBox() && !intersectWithBoxModel(&model)) flags |= flag::kOutside;
    if (doesSelfCollide(&model)) flags |= flag::kTouchesItself;
    return flags;
  }
};

std::string titleOf(const InputSettings& input) {
  std::vector<std::string> names;
  for (const std::string& path : input.paths) {
    const std::filesystem::path clean = std::filesystem::path(path).lexically_normal();
    names.push_back((clean.has_filename() ? clean : clean.parent_path()).filename().string());
  }
  constexpr std::size_t kShown = 3;
  if (names.size() <= kShown) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", names.front(), names.size() - 1);
}

void addColumns(const scene::Scene& from, view::ViewScene& to) {
  Numbering<std::string> types;
  Numbering<std::vector<int>> groups;
  Numbering<const void*> owners;
  groups.numberOf({});
  for (const auto& model : from.models) {
    const scene::ModelRecord record = scene::modelRecord(*model);
    to.names.push_back(record.name);
    to.types.push_back(types.numberOf(record.type));
    to.groups.push_back(groups.numberOf(record.groups));
    to.owners.push_back(owners.numberOf(model->getOwner()));
    to.elements.push_back(static_cast<std::uint32_t>(record.elements));
    to.contactDistances.push_back(record.contactDistance);
    view::addModel(to.mesh, *model);
  }
  to.typeNames = types.keys();
  to.groupSets = groups.keys();
}

view::ViewFrame frameOf(const scene::Scene& scene, const Detection& detection) {
  ModelProbe probe(scene);
  view::ViewFrame frame;
  for (const auto& model : scene.models) {
    frame.boxes.push_back(scene::modelRecord(*model).box);
    frame.flags.push_back(probe.flagsOf(*model));
  }
  frame.pairs.assign(detection.pairs.begin(), detection.pairs.end());
  return frame;
}

void fill(scene::Scene& from, const DetectionOptions& options, view::ViewScene& to) {
  const Detection detection = detectScene(from, options);
  to.method = methodText(from);
  to.distance = from.intersection->getAlarmDistance();
  to.addsContactDistances = from.intersection->addsContactDistances();
  to.region = from.region;
  to.modelCount = from.models.size();
  to.ignored = from.remarks;
  to.statistics = detection.statistics;
  addColumns(from, to);
  to.frames.push_back(frameOf(from, detection));
  to.frames.front().excluded = view::excludedPairs(to, to.frames.front());
}

/// The columns of boxes, which have neither flags nor groups.
void addBoxColumns(std::size_t count, view::ViewScene& to) {
  to.modelCount = count;
  to.typeNames = {"BoxModel"};
  to.groupSets = {{}};
  to.types.assign(count, 0);
  to.groups.assign(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) to.owners.push_back(i);
  to.elements.assign(count, 1);
  to.contactDistances.assign(count, 0.0);
}

/// Names that are only indices are left out: the page knows them.
void addBoxNames(const scene::BoxArray& boxes, view::ViewScene& to) {
  bool areIndices = true;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    to.names.push_back(boxes.name(i));
    areIndices = areIndices && to.names.back() == std::to_string(i);
  }
  if (areIndices) to.names.clear();
}

view::ViewFrame boxFrame(const BoxSet& boxes, const DetectionOptions& options) {
  view::ViewFrame frame;
  const double distance = options.margin.value_or(0.0);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box box = boxes[i];
    const bool isOutside = options.region && !overlap(*options.region, box, distance);
    const unsigned flags = flag::kActive | flag::kSimulated | flag::kMoving | (isOutside ? flag::kOutside : 0U);
    frame.boxes.push_back(box);
    frame.flags.push_back(static_cast<std::uint8_t>(flags));
  }
  return frame;
}

std::string boxMethod(const DetectionOptions& options) {
  std::string text = options.margin ? fmt::format("boxes at most {} apart on every axis", *options.margin) : "boxes";
  if (options.region) text += fmt::format(", in the region {}", boxText(*options.region));
  return text;
}

void fill(scene::BoxArray& from, const DetectionOptions& options, view::ViewScene& to) {
  to.method = boxMethod(options);
  to.distance = options.margin.value_or(0.0);
  to.region = options.region;
  addBoxColumns(from.size(), to);
  addBoxNames(from, to);
  const Detection detection = detectBoxes(from, BoxPairOrder::NewestFirst, options);
  view::ViewFrame frame = boxFrame(from.boxes(), options);
  for (const auto& [first, second] : detection.pairs) frame.pairs.push_back({second, first});
  to.frames.push_back(std::move(frame));
  to.statistics = detection.statistics;
}

/// One frame of a sequence: its pairs newest first, as a scene's.
view::ViewFrame searchFrame(const BoxSet& boxes, const DetectionOptions& options, Overlaps& search) {
  view::ViewFrame frame = boxFrame(boxes, options);
  for (const auto& [first, second] : search.find(boxes)) frame.pairs.push_back({second, first});
  return frame;
}

OverlapOptions frameOptions(const view::ViewScene& scene, Executor* executor) {
  OverlapOptions options;
  options.order = Order::BySecond;
  options.distance = scene.distance;
  options.region = scene.region;
  options.executor = executor;
  return options;
}

void fillFrames(scene::BoxFrames& from, const DetectionOptions& options, view::ViewScene& to) {
  to.method = fmt::format("{}, {}", boxMethod(options), counted(from.frameCount(), "frame"));
  to.distance = options.margin.value_or(0.0);
  to.region = options.region;
  addBoxColumns(from.boxCount(), to);
  const auto executor = makeExecutor(options.threads, from.boxCount());
  Overlaps search(frameOptions(to, executor.get()));
  const std::uint64_t all = from.boxCount() == 0 ? 0 : std::uint64_t{from.boxCount()} * (from.boxCount() - 1) / 2;
  to.statistics.strategy = strategyName(options.strategy);
  to.statistics.distance = to.distance;
  const Timer timer;
  for (std::size_t i = 0; i < from.frameCount(); ++i) {
    to.frames.push_back(searchFrame(from.next(), options, search));
    to.statistics.testsOfAllPairs += all;
    to.statistics.testsMade += search.statistics().boxTests + search.statistics().groupTests;
  }
  to.statistics.detectSeconds = timer.seconds();
}

/// Frames are read alone: they are not put together with other inputs.
bool areFrames(const InputSettings& input) {
  const bool isAny = std::any_of(input.paths.begin(), input.paths.end(),
                                 [](const std::string& path) { return scene::isBoxFramesFile(path); });
  if (isAny && input.paths.size() > 1) throw UsageError("boxes over time cannot be put together with other inputs");
  return isAny;
}

}  // namespace

view::ViewScene makeViewScene(const InputSettings& input, const DetectionOptions& options) {
  view::ViewScene result;
  result.title = titleOf(input);
  const Timer timer;
  if (areFrames(input)) {
    scene::BoxFrames frames(input.paths.front());
    result.statistics.readSeconds = timer.seconds();
    fillFrames(frames, options, result);
    return result;
  }
  Inputs inputs = readInputs(input);
  const double readSeconds = timer.seconds();
  std::visit([&](auto& content) { fill(content, options, result); }, inputs);
  result.statistics.readSeconds = readSeconds;
  return result;
}

}  // namespace allpairs::app
