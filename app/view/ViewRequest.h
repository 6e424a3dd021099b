// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "detect/Detection.h"
#include "detect/SearchArguments.h"
#include "view/Bodies.h"

namespace allpairs::app {

/// Whether shapes are tested too.
enum class ShapeTest : std::uint8_t {
  Never,
  WhereShapesAre,  ///< If the input has anything but boxes; of SOFA scenes alone, pairs of boxes are asked.
  Always,
};

/// What a page or a report is asked for.
struct ViewRequest {
  DetectionOptions detection{};
  ShapeTest shapes = ShapeTest::Never;
  Grouping grouping = Grouping::Body;
  bool isForPage = false;   ///< What is too much for a page is an error; a report can do without one.
  std::optional<int> up{};  ///< The axis that points up, 1 to 3 for x to z; else as the input says.
};

/// The options that view and report have in common.
struct ViewArguments {
  SearchArguments search;
  bool exact = false;
  bool boxes = false;
  std::string group = "body";
  std::string up;
  std::string threads = "0";
};

/// Declares --distance, --box, --clearance, --exact, --boxes, --group, --up and --threads.
void addViewOptions(CLI::App& command, ViewArguments& arguments);

/// Bad input: UsageError for values that are none, for --exact in a program that has not the library for it, and for
///            options that contradict each other.
[[nodiscard]] ViewRequest viewRequest(const ViewArguments& arguments);

}  // namespace allpairs::app
