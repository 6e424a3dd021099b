// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace allpairs::app {

/// Each command has a file of its own that declares its options and runs it when it is chosen.
void addBench(CLI::App& program);
void addCompletion(CLI::App& program);
void addDetect(CLI::App& program);
void addElements(CLI::App& program);
void addGenerate(CLI::App& program);
void addInfo(CLI::App& program);
void addJoin(CLI::App& program);
void addPlan(CLI::App& program);
void addTrack(CLI::App& program);
void addReport(CLI::App& program);
void addView(CLI::App& program);

}  // namespace allpairs::app
