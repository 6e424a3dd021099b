// SPDX-License-Identifier: MIT
#include "view/ViewRequest.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "detect/Exact.h"

namespace allpairs::app {

void addViewOptions(CLI::App& command, ViewArguments& arguments) {
  addSearchOptions(command, arguments.search);
  command.add_flag("--exact", arguments.exact, "Test shapes, and hide pairs that are apart; the default for meshes");
  command.add_flag("--boxes", arguments.boxes,
                   "Show all pairs of boxes, as detect does, and test no shapes; the default for SOFA scenes");
  addChoice(command, "--group", arguments.group, {"body", "assembly", "file", "none"})
      ->description("What is one row: pairs of the same two bodies, assemblies or files, or each pair of models")
      ->capture_default_str();
  addChoice(command, "--up", arguments.up, {"x", "y", "z"})
      ->description("The axis that points up; by default as the format says, else z");
  addThreads(command, arguments.threads);
}

ViewRequest viewRequest(const ViewArguments& arguments) {
  if (arguments.exact && arguments.boxes) throw UsageError("--exact tests shapes, --boxes does not: give one of them");
  if (arguments.boxes && arguments.search.clearance)
    throw UsageError("--clearance is measured between shapes, which --boxes does not test; --distance is for boxes");
  if (arguments.boxes && arguments.search.leastDepth)
    throw UsageError("--min-depth is of shapes, which --boxes does not test");
  ViewRequest request{.detection = detectionOptions(arguments.search), .shapes = ShapeTest::WhereShapesAre};
  request.detection.threads = parseThreads(arguments.threads);
  if (arguments.exact || arguments.search.clearance || arguments.search.leastDepth) request.shapes = ShapeTest::Always;
  if (arguments.boxes) request.shapes = ShapeTest::Never;
  if (request.shapes == ShapeTest::Always) requireExact();
  if (arguments.group == "assembly") request.grouping = Grouping::Assembly;
  if (arguments.group == "file") request.grouping = Grouping::File;
  if (arguments.group == "none") request.grouping = Grouping::None;
  if (!arguments.up.empty()) request.up = arguments.up[0] - 'x' + 1;
  return request;
}

}  // namespace allpairs::app
