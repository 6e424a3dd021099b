// SPDX-License-Identifier: MIT
#include "detect/Why.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <system_error>

#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "allpairs/scene/WriteResult.h"
#include "cli/ExitStatus.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

using collision::CollisionModel;
using collision::PairRule;

std::vector<std::size_t> modelsNamed(const scene::Scene& scene, const std::string& name) {
  std::vector<std::size_t> named;
  for (std::size_t i = 0; i < scene.models.size(); ++i) {
    if (scene.models[i]->getName() == name) named.push_back(i);
  }
  return named;
}

/// The model of that name, or else of that number; of a name that is a number too, "#7" is the number.
std::size_t modelOf(const scene::Scene& scene, const std::string& text) {
  constexpr std::size_t kMostListed = 5;
  const std::vector<std::size_t> named = modelsNamed(scene, text);
  if (named.size() == 1) return named.front();
  if (named.size() > 1) {
    const auto listed = named.begin() + static_cast<std::ptrdiff_t>(std::min(named.size(), kMostListed));
    throw UsageError(fmt::format("--why: {} models are called '{}': number {}{}; say which by its number, as in #{}",
                                 named.size(), text, fmt::join(named.begin(), listed, ", "),
                                 listed == named.end() ? "" : ", ...", named.front()));
  }
  const auto number = numberOf<std::size_t>(std::string_view(text).substr(text.starts_with('#') ? 1 : 0));
  if (number && *number < scene.models.size()) return *number;
  throw UsageError(fmt::format("--why: of {}, none has the name or the number '{}'; 'allpairs info' lists them",
                               counted(scene.models.size(), "model"), text));
}

/// Two models of one search, the newer first, and all that the sentence on them needs.
struct Question {
  const scene::Scene& scene;
  const scene::SceneSearch& search;
  std::array<std::size_t, 2> models;

  [[nodiscard]] bool isOfOne() const { return models[0] == models[1]; }
  [[nodiscard]] CollisionModel& model(std::size_t i) const { return *scene.models[models[i]]; }
  [[nodiscard]] Box box(std::size_t i) const { return scene::modelRecord(model(i)).box; }
  [[nodiscard]] std::string name(std::size_t i) const {
    const std::string number = std::to_string(models[i]);
    return '\'' + printable(model(i).getName()) + '\'' + (model(i).getName() == number ? "" : " (" + number + ')');
  }
  [[nodiscard]] double distance() const { return search.intersection->distanceBetween(model(0), model(1)); }
};

std::string ownerOf(const scene::Scene& scene, const CollisionModel& model) {
  const auto owner = std::find_if(scene.owners.begin(), scene.owners.end(),
                                  [&model](const auto& one) { return one.get() == model.getOwner(); });
  if (owner == scene.owners.end() || (*owner)->path.empty()) return "of one node";
  return "of one node or body, '" + printable((*owner)->path) + '\'';
}

/// "both are of one body, ..., and 'a' may not collide with itself".
std::string reasonOfOwner(const Question& asked) {
  if (asked.isOfOne()) return "it may not collide with itself: selfCollision is off";
  std::vector<std::string> names;
  for (const std::size_t i : {0U, 1U}) {
    if (!asked.model(i).getSelfCollision()) names.push_back(asked.name(i));
  }
  return fmt::format("both are {}, and selfCollision of {} is off", ownerOf(asked.scene, asked.model(0)),
                     fmt::join(names, " and "));
}

std::string reasonOfGroups(const Question& asked) {
  const std::vector<int>& a = asked.model(0).getGroups();
  const std::vector<int>& b = asked.model(1).getGroups();
  std::vector<int> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return fmt::format("both are in the group {}", fmt::join(common, ", "));
}

/// Of models whose roots the method has looked at.
std::string reasonOfBoxes(const Question& asked) {
  for (const std::size_t i : {0U, 1U}) {
    if (isEmpty(asked.box(i))) return "the box of " + asked.name(i) + " is empty: its min is above its max";
  }
  if (asked.isOfOne() && asked.distance() < 0.0) return "its box does not touch itself at a distance below 0";
  if (asked.isOfOne()) return "it is too flat to touch itself";
  return "their boxes are too far apart";
}

std::string reasonOf(const Question& asked, const collision::PairVerdict& verdict) {
  const std::string name = asked.name(verdict.model == &asked.model(0) ? 0 : 1);
  switch (verdict.rule) {
    case PairRule::None:
      return asked.isOfOne() ? "selfCollision is on" : "their boxes are near enough, and no rule excludes them";
    case PairRule::NoElements:
      return name + " has no elements";
    case PairRule::OutsideRegion:
      return name + " is outside of the region " + boxText(*asked.search.region);
    case PairRule::NotSimulated:
      return asked.isOfOne() ? "it is not simulated" : "neither of them is simulated";
    case PairRule::OneOwner:
      return reasonOfOwner(asked);
    case PairRule::CommonGroup:
      return reasonOfGroups(asked);
    case PairRule::Refused:
      return "one of them refuses the other";
    case PairRule::NoIntersector:
      return fmt::format("{} has no test for the two", asked.search.intersection->typeName());
    case PairRule::Apart:
      return reasonOfBoxes(asked);
  }
  return {};
}

/// How far `low` lies above `high`; of the same infinity it is near at any distance, as the search has it.
double gapBetween(double high, double low) {
  const double gap = low - high;
  return std::isnan(gap) ? -std::numeric_limits<double>::infinity() : gap;
}

/// How far the boxes are apart; nothing where there is no gap to speak of.
std::string gapLine(const Question& asked) {
  const Box a = asked.box(0);
  const Box b = asked.box(1);
  if (asked.isOfOne() || isEmpty(a) || isEmpty(b)) return {};
  const auto gap = [&](std::size_t axis) {
    return std::max(gapBetween(a.max[axis], b.min[axis]), gapBetween(b.max[axis], a.min[axis]));
  };
  return fmt::format(
      "  gaps of the boxes: {} on x, {} on y, {} on z, below 0 where they overlap; a pair has at most {}\n", gap(0),
      gap(1), gap(2), asked.distance());
}

/// Judges the two as the step of a pipeline does.
std::string answerTo(const Question& asked) {
  collision::BruteForceBroadPhase broadPhase;
  if (asked.search.region) broadPhase.setBox(*asked.search.region);
  collision::CollisionPipeline pipeline;
  pipeline.setIntersectionMethod(asked.search.intersection);
  pipeline.setBroadPhase(&broadPhase);
  const std::array<CollisionModel*, 2> models{&asked.model(0), &asked.model(1)};
  pipeline.computeBoundingTrees(models, asked.scene.timeStep);
  const std::string names = asked.isOfOne() ? asked.name(0) : asked.name(0) + " and " + asked.name(1);
  const std::string with = asked.isOfOne() ? " with itself" : "";
  const std::string be = asked.isOfOne() ? " is " : " are ";
  for (const std::size_t i : {0U, 1U}) {
    if (collision::CollisionPipeline::takes(models[i])) continue;
    return fmt::format("{}{}no pair{}: {} {}\n", names, be, with, asked.name(i),
                       models[i]->isActive() ? "has no elements" : "is not active");
  }
  const collision::PairVerdict verdict = broadPhase.judge(models[0], models[1]);
  return fmt::format("{}{}{}{}: {}\n{}", names, be, verdict.isPair() ? "a pair" : "no pair", with,
                     reasonOf(asked, verdict), gapLine(asked));
}

/// The place of a model among those of a search; the number of them where it is not one.
std::size_t placeIn(const scene::SceneSearch& search, std::size_t model) {
  return static_cast<std::size_t>(std::find(search.indices.begin(), search.indices.end(), model) -
                                  search.indices.begin());
}

}  // namespace

std::string whyText(scene::Scene& scene, const std::vector<std::string>& models, const DetectionOptions& options) {
  std::array<std::size_t, 2> asked{modelOf(scene, models[0]), modelOf(scene, models[1])};
  apply(options, scene);
  const std::vector<scene::SceneSearch> searches = scene::searchesOf(scene);
  std::string text;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    const scene::SceneSearch& search = searches[i];
    const std::size_t first = placeIn(search, asked[0]);
    const std::size_t second = placeIn(search, asked[1]);
    if (std::max(first, second) == search.indices.size()) continue;
    if (first < second) std::swap(asked[0], asked[1]);  // the newer one first
    if (!scene.pipelines.empty()) text += "in " + printable(scene.pipelines[i].name) + ": ";
    text += answerTo({scene, search, asked});
  }
  return text.empty() ? "they are no pair: no collision pipeline of the scene takes both\n" : text;
}

}  // namespace allpairs::app
