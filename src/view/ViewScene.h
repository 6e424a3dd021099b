// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Pair.h"
#include "allpairs/collision/ExactPair.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::view {

/// What the rules know of one model in one frame, as bits; web/src/rules.js has the same numbers.
namespace flag {
inline constexpr std::uint8_t kActive = 1;
inline constexpr std::uint8_t kSimulated = 2;
inline constexpr std::uint8_t kMoving = 4;
inline constexpr std::uint8_t kSelfCollision = 8;
inline constexpr std::uint8_t kOutside = 16;  ///< Does not touch the region.
inline constexpr std::uint8_t kNoElements = 32;
inline constexpr std::uint8_t kTouchesItself = 64;  ///< The model's root with itself, if its box is near itself.
}  // namespace flag

/// The shapes of all models in one block. Model i has the entries from ends[i - 1] (0 for the first) to ends[i].
struct ViewMesh {
  std::vector<double> vertices;  ///< x y z.
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> lines;
  std::vector<std::uint32_t> points;
  std::vector<std::uint32_t> triangleEnds;  ///< Counted in indices: three a triangle, two a line, one a point.
  std::vector<std::uint32_t> lineEnds;
  std::vector<std::uint32_t> pointEnds;
  bool isShortened = false;  ///< Models from some place on have no shape, because there would be too much of it.
};

/// Boxes and pairs at one moment. Pairs are oriented and ordered as a result has them.
struct ViewFrame {
  std::vector<Box> boxes;
  std::vector<std::uint8_t> flags;
  std::vector<Pair> pairs;
  std::vector<Pair> excluded;  ///< (newer, older): the boxes are near enough, and a rule says no.
  std::size_t began = 0;       ///< Of a sequence: how many pairs the frame before did not have, and of its how many
  std::size_t ended = 0;       ///< are none any more.
  std::vector<double> positions{};  ///< Of a sequence of meshes: x y z of each vertex; its boxes are the triangles'.
};

/// All that a page or a report shows: models, what the rules read of them, and what was found, frame by frame.
struct ViewScene {
  std::string title;
  std::string method;  ///< How models are tested, in words.
  double distance = 0.0;
  bool addsContactDistances = false;
  std::optional<Box> region;
  std::size_t modelCount = 0;
  std::vector<std::string> names;  ///< Empty: a model is called by its index.
  std::vector<std::string> typeNames;
  std::vector<std::vector<int>> groupSets;  ///< The first is empty.
  std::vector<std::uint32_t> types;         ///< Of each model, an index into typeNames.
  std::vector<std::uint32_t> groups;        ///< Of each model, an index into groupSets.
  std::vector<std::uint32_t> owners;        ///< Models with the same number are one body.
  std::vector<std::uint32_t> elements;
  std::vector<double> contactDistances;
  ViewMesh mesh;
  std::vector<std::uint32_t> corners;  ///< Of a sequence of meshes, whose models are triangles: three vertices each.
  std::vector<ViewFrame> frames;       ///< At least one.
  bool leavesOutExcluded = false;      ///< There are so many excluded pairs that frames have none of them.
  std::vector<scene::Remark> ignored;
  scene::DetectionStatistics statistics;
  /// What the shapes of the first frame's pairs say, in their order; empty: not asked.
  std::vector<ExactPair> exact{};
  std::vector<std::uint8_t> sides{};  ///< From where each of these pairs is seen best, if chooseSides() was called.
  double exactSeconds = 0.0;
  double clearance = 0.0;
  int up = 3;                             ///< The axis that points up, 1 to 3 for x to z; below 0: it points down.
  std::optional<double> metresPerUnit{};  ///< Where the input says so.

  bool isExact = false;  ///< Whether shapes were asked.

  /// Models whose pairs are one row: of each the number of its body, or of its file. Empty where each is for itself.
  std::vector<std::uint32_t> bodies{};
  std::vector<std::string> bodyNames{};

  /// Of each model the file that it was read from, as it is known in reports to come, and where it is in there: its
  /// name, behind those of the nodes that it is in. Empty where models are of no file.
  std::vector<std::string> fileNames{};
  std::vector<std::uint32_t> files{};  ///< Of each model, an index into fileNames.
  std::vector<std::string> paths{};

  /// What a model, and a body, is known by in reports to come: an IFC's GlobalId, or these two. Empty where nothing but names and numbers is known.
  std::vector<std::string> identities{};
  std::vector<std::string> bodyIdentities{};

  /// Of each model, in the format's own words: "IfcColumn"; empty where none has one.
  std::vector<std::string> kinds{};
  std::vector<std::string> ids{};  ///< Of each model its GlobalId, where it has one.

  [[nodiscard]] std::uint32_t bodyOf(std::uint32_t model) const { return bodies.empty() ? model : bodies[model]; }
  [[nodiscard]] std::string bodyName(std::uint32_t model) const {
    return bodies.empty() ? name(model) : bodyNames[bodies[model]];
  }

  [[nodiscard]] std::string name(std::size_t model) const {
    return names.empty() ? std::to_string(model) : names[model];
  }
};

}  // namespace allpairs::view
