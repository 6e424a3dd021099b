// SPDX-License-Identifier: MIT
#include "SearchArguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "Arguments.h"

namespace allpairs::app {

void addSearchOptions(CLI::App& command, SearchArguments& arguments) {
  command
      .add_option("--margin", arguments.margin,
                  "Pairs may be this far apart on every axis; for a scene: its alarmDistance")
      ->type_name("D");
  command.add_option("--box", arguments.box, "Leave out models that do not touch this region")
      ->type_name("x0,y0,z0,x1,y1,z1");
}

DetectionOptions detectionOptions(const SearchArguments& arguments) {
  DetectionOptions options;
  if (!arguments.margin.empty()) options.margin = parseMargin(arguments.margin);
  if (!arguments.box.empty()) options.region = parseRegion(arguments.box);
  return options;
}

}  // namespace allpairs::app
