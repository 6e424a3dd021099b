// SPDX-License-Identifier: MIT
#include "detect/SearchArguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/Arguments.h"

namespace allpairs::app {

void addSearchOptions(CLI::App& command, SearchArguments& arguments) {
  command
      .add_option("--distance", arguments.distance,
                  "Report pairs up to D apart on every axis; replaces a scene's alarmDistance")
      ->type_name("D");
  command.add_option("--box", arguments.box, "Ignore models outside of this region")->type_name("x0,y0,z0,x1,y1,z1");
  command.add_option("--clearance", arguments.clearance, "Of shapes: also report pairs that are up to D apart")
      ->type_name("D");
  command.add_option("--min-depth", arguments.leastDepth, "Of shapes: clashes that are up to D deep only touch")
      ->type_name("D");
}

DetectionOptions detectionOptions(const SearchArguments& arguments) {
  DetectionOptions options;
  if (arguments.distance) options.distance = parseDistance(*arguments.distance);
  if (arguments.box) options.region = parseRegion(*arguments.box);
  if (arguments.clearance) options.clearance = parseLength("--clearance", *arguments.clearance);
  if (arguments.leastDepth) options.leastDepth = parseLength("--min-depth", *arguments.leastDepth);
  return options;
}

}  // namespace allpairs::app
