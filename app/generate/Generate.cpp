// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Commands.h"
#include "allpairs/generate/BoxMotions.h"
#include "cli/ExitStatus.h"
#include "cli/NpyOutput.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "cli/Terminal.h"
#include "cli/Text.h"
#include "generate/SceneArguments.h"

namespace allpairs::app {
namespace {

struct GenerateSettings {
  SceneArguments scene;
  std::uint64_t frames = 1000;  // as many as Broadmark's scenes have
  bool hasFrames = false;
  std::string output;
};

constexpr const char* kGenerateExamples = R"(Examples:
  allpairs generate uniform -n 100000 -o boxes.npy
  allpairs generate needles -n 50000 --seed 7 --sorted -o needles.npy
  allpairs generate brownian -n 10000 --frames 200 -o frames.npy

The file holds a NumPy array (n, 6), float32: minx miny minz maxx maxy maxz; of a
motion (t, n, 6). The same scene, number, seed and order give the same bytes on every
machine.)";

bool isMotion(const std::string& name) {
  const auto motions = generate::boxMotions();
  return std::any_of(motions.begin(), motions.end(), [&](const generate::BoxMotion& m) { return m.name == name; });
}

std::string motionList() {
  constexpr std::size_t kColumn = 18;
  std::string text = "Motions of equal cubes that fill a tenth of a unit cube:";
  for (const generate::BoxMotion& motion : generate::boxMotions()) {
    std::string name(motion.name);
    name.resize(kColumn, ' ');
    text.append("\n  ").append(name).append(motion.description);
  }
  return text;
}

/// A name that promises another format would be a lie.
void checkExtension(const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension.empty() || extension == ".npy") return;
  throw UsageError("-o: '" + path + "': boxes are written as a NumPy array, whose files end in .npy");
}

void writeBoxes(const SceneArguments& scene, Output& output) {
  const generate::SceneRequest request = sceneRequest(scene);
  NpyOutput(output, "<f4", {request.count, 6}).add(generate::makeBoxes(request));
}

/// Frame by frame: there is never more than one in memory.
void writeFrames(const GenerateSettings& settings, Output& output) {
  generate::MotionFrames motion({settings.scene.scene, settings.scene.count, settings.scene.seed});
  NpyOutput file(output, "<f4", {settings.frames, settings.scene.count, 6});
  ProgressLine line;
  const std::uint64_t frames = settings.scene.count == 0 ? 0 : settings.frames;  // those without boxes have no bytes
  for (std::uint64_t frame = 0; frame < frames; ++frame) {
    line.show(frame, frames, "frame " + grouped(frame + 1) + " of " + grouped(frames));
    file.add(motion.next());
  }
}

/// The bytes of the boxes of all frames; the largest number where there are more.
std::uint64_t bytesOf(const GenerateSettings& settings) {
  const std::uint64_t frame = settings.scene.count * 6 * sizeof(float);
  const std::uint64_t frames = isMotion(settings.scene.scene) ? settings.frames : 1;
  const bool isTooMuch = frame != 0 && frames > std::numeric_limits<std::uint64_t>::max() / frame;
  return isTooMuch ? std::numeric_limits<std::uint64_t>::max() : frames * frame;
}

void checkScene(const GenerateSettings& settings) {
  const SceneArguments& scene = settings.scene;
  if (isMotion(scene.scene)) {
    if (scene.sorted) throw UsageError("--sorted does not apply to moving boxes");
    if (scene.count > std::numeric_limits<std::uint32_t>::max()) {
      throw UsageError("-n: a motion has at most 4294967295 boxes");
    }
    return;
  }
  if (settings.hasFrames && isSceneName(scene.scene)) {
    throw UsageError("--frames: the boxes of '" + scene.scene + "' do not move; --frames needs a motion");
  }
  static_cast<void>(sceneRequest(scene));
}

void runGenerate(const GenerateSettings& settings) {
  checkExtension(settings.output);
  checkScene(settings);
  Output output(targetOf(settings.output));
  if (output.isTerminal()) {
    throw UsageError("boxes are binary and are not written to a terminal: use -o FILE, or redirect the output");
  }
  output.requireRoom(bytesOf(settings));
  isMotion(settings.scene.scene) ? writeFrames(settings, output) : writeBoxes(settings.scene, output);
  output.commit();
  if (!settings.output.empty()) sayWritten(counted(settings.scene.count, "box", "boxes"), settings.output);
}

}  // namespace

void addGenerate(CLI::App& program) {
  const auto settings = std::make_shared<GenerateSettings>();
  CLI::App* command = program.add_subcommand("generate", "Generate boxes for benchmarks, static or moving");
  command->footer(sceneList() + "\n\n" + motionList() + "\n\n" + kGenerateExamples);
  command->add_option("SCENE", settings->scene.scene, "The kind of boxes; see below")->required()->type_name("");
  addSceneOptions(*command, settings->scene);
  CLI::Option* frames = command->add_option("--frames", settings->frames, "Number of frames of a motion")
                            ->type_name("T")
                            ->capture_default_str();
  takeCount(*frames);
  addOutput(*command, settings->output);
  command->callback([settings, frames] {
    settings->hasFrames = frames->count() != 0;
    runGenerate(*settings);
  });
}

}  // namespace allpairs::app
