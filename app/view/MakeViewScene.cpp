// SPDX-License-Identifier: MIT
#include "view/MakeViewScene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "ClashPicture.h"
#include "Explain.h"
#include "ModelMesh.h"
#include "PageSize.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "allpairs/scene/ReadInput.h"
#include "cli/ExitStatus.h"
#include "cli/Text.h"
#include "cli/Timer.h"
#include "detect/Exact.h"
#include "view/Bodies.h"
#include "view/ViewBoxes.h"
#include "view/ViewFrames.h"

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
    if (doesSelfCollide(&model) || isOnlyTooThin(model)) flags |= flag::kTouchesItself;
    return flags;
  }

 private:
  /// Whether a model that does not touch itself would at another distance, which the page may be asked for.
  bool isOnlyTooThin(CollisionModel& model) {
    const collision::CollisionElement root{model.getFirst(), 0};
    collision::Intersection& method = *getIntersectionMethod();
    bool swap = false;
    return method.findIntersector(root.model, root.model, swap) != nullptr &&
           root.cone().halfAngle >= std::numbers::pi / 2.0 &&
           !overlap(root.box(), root.box(), method.distanceBetween(*root.model, *root.model));
  }
};

/// By what models are known later, and what their format says that they are.
void addSources(const scene::Scene& from, view::ViewScene& to) {
  if (from.sources.size() != from.models.size()) return;
  const std::vector<std::string> files = fileIdentities(from);
  Identities identities;
  bool hasKinds = false;
  to.fileNames = files;
  for (const scene::ModelSource& source : from.sources) {
    to.files.push_back(static_cast<std::uint32_t>(source.file));
    to.paths.push_back(source.path.empty() ? source.name : source.path);
    to.identities.push_back(
        identities.unique(source.id.empty() ? files[source.file] + '\n' + to.paths.back() : source.id));
    to.kinds.push_back(source.kind);
    to.ids.push_back(source.id);
    hasKinds = hasKinds || !source.kind.empty();
  }
  if (!hasKinds) to.kinds.clear();
  if (!hasKinds) to.ids.clear();
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
  addSources(from, to);
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

bool hasShapes(const scene::Scene& scene) {
  return std::any_of(scene.models.begin(), scene.models.end(), [](const auto& model) {
    return dynamic_cast<const collision::BoxModel*>(model->getLast()) == nullptr && !model->getLast()->empty();
  });
}

/// Whether shapes are to be tested; the page says so where they are not because this program cannot.
bool testsShapes(const scene::Scene& scene, ShapeTest test, view::ViewScene& to) {
  if (test != ShapeTest::WhereShapesAre) return test == ShapeTest::Always;
  if (!hasShapes(scene)) return false;
  if (!hasExact()) to.method += "; shapes are not tested, because this program was built without FCL";
  return hasExact();
}

void addExact(const scene::Scene& from, const ViewRequest& request, view::ViewScene& to) {
  constexpr std::size_t kMostLines = 2000;     // of a contact: more are not told apart in a picture
  constexpr std::size_t kMostInAll = 200'000;  // five megabytes of a page
  constexpr std::size_t kLeastLines = 32;
  if (!testsShapes(from, request.shapes, to)) return;
  const std::vector<Pair>& pairs = to.frames.front().pairs;
  const double clearance = request.detection.clearance;
  const std::size_t lines = std::clamp(kMostInAll / (pairs.size() + 1), kLeastLines, kMostLines);
  const double leastDepth = request.detection.leastDepth;
  ExactReport report = examine(from, pairs, {.clearance = clearance, .leastDepth = leastDepth, .lineLimit = lines});
  for (ExactPair& pair : report.pairs) pair.first = pair.second = nullptr;  // which end with the scene that was read
  to.isExact = true;
  if (to.method == "boxes") to.method = "shapes";
  if (leastDepth > 0.0) to.method += fmt::format("; clashes are deeper than {}", leastDepth);
  to.exact = std::move(report.pairs);
  to.exactSeconds = report.seconds;
  to.clearance = clearance;
}

/// Gives the first frame the pairs that a rule excludes. More than a million would show nothing, and take the room of
/// those that count.
void addExcluded(view::ViewScene& to) {
  constexpr std::size_t kMost = 1'000'000;
  view::ViewFrame& frame = to.frames.front();
  std::optional<std::vector<Pair>> excluded = view::excludedPairs(to, frame, kMost);
  to.leavesOutExcluded = !excluded;
  if (excluded) frame.excluded = *std::move(excluded);
}

/// Of what a page must show, throws before pairs are copied that are too many for it.
void checkPage(const ViewRequest& request, const view::ViewScene& scene, std::size_t pairs) {
  if (request.isForPage) view::checkPageSize(scene, 1, scene.modelCount * sizeof(Box) + pairs * sizeof(Pair));
}

void fill(scene::Scene& from, const ViewRequest& request, view::ViewScene& to) {
  if (!from.pipelines.empty())
    throw UsageError(
        "this scene has several collision pipelines, of which a page would show one; 'allpairs detect' finds "
        "the pairs of all (docs/scenes.md)");
  const Detection detection = detectScene(from, request.detection);
  to.method = methodText(from);
  to.distance = from.intersection->getAlarmDistance();
  to.addsContactDistances = from.intersection->addsContactDistances();
  to.region = from.region;
  to.modelCount = from.models.size();
  checkPage(request, to, detection.pairs.size());
  if (from.up != 0) to.up = from.up;
  to.metresPerUnit = from.metresPerUnit;
  to.ignored = from.remarks;
  to.statistics = detection.statistics;
  addColumns(from, to);
  addBodies(from, request.grouping, to);
  to.frames.push_back(frameOf(from, detection));
  addExcluded(to);
  addExact(from, request, to);
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

/// Of boxes, each of which is in one group.
void addGroups(const std::vector<std::uint32_t>& groups, view::ViewScene& to) {
  if (groups.empty()) return;
  to.groups = groups;
  for (std::uint32_t group = 1; group <= groups.back(); ++group) to.groupSets.push_back({static_cast<int>(group)});
}

void fill(const BoxInput& input, const ViewRequest& request, view::ViewScene& to) {
  const scene::BoxArray& from = input.boxes;
  if (request.shapes == ShapeTest::Always) {
    scene::Scene scene = toScene(input);
    fill(scene, request, to);
    return;
  }
  DetectionOptions options = request.detection;
  options.groups = input.groups;
  to.method = boxMethod(options.distance, options.region);
  to.distance = options.distance.value_or(0.0);
  to.region = options.region;
  addBoxColumns(from.size(), to);
  addGroups(input.groups, to);
  addBoxNames(from, to);
  const Detection detection = detectBoxes(from, BoxPairOrder::NewestFirst, options);
  checkPage(request, to, detection.pairs.size());
  view::ViewFrame frame = boxFrame(from.boxes(), options);
  for (const auto& [first, second] : detection.pairs) frame.pairs.push_back({second, first});
  to.frames.push_back(std::move(frame));
  if (!input.groups.empty()) addExcluded(to);
  to.statistics = detection.statistics;
}

}  // namespace

view::ViewScene makeViewScene(const InputSettings& input, const ViewRequest& request) {
  if (isAnyBoxFrames(input.paths)) {
    if (input.betweenInputs) throw UsageError("--between-inputs is not for boxes in frames");
    return makeViewFrames(input, request);
  }
  view::ViewScene result;
  result.title = titleOf(input);
  const Timer timer;
  Inputs inputs = readInputs(input);
  const double readSeconds = timer.seconds();
  if (const auto* scene = std::get_if<scene::Scene>(&inputs)) warnOfPart(input, *scene);
  ViewRequest asked = request;
  if (asked.shapes == ShapeTest::WhereShapesAre && areScenes(input)) asked.shapes = ShapeTest::Never;
  std::visit([&](auto& content) { fill(content, asked, result); }, inputs);
  result.method += betweenText(input);
  result.statistics.readSeconds = readSeconds;
  result.up = request.up.value_or(result.up);
  constexpr std::size_t kMostSides = 500;  // as many as a report has pictures
  parallel::TbbExecutor executor(request.detection.threads);
  view::chooseSides(result, kMostSides, executor);
  return result;
}

}  // namespace allpairs::app
