// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Commands.h"
#include "ExitStatus.h"
#include "Output.h"
#include "OutputOption.h"
#include "SceneArguments.h"

namespace allpairs::app {
namespace {

struct GenerateSettings {
  SceneArguments scene;
  std::string output;
};

constexpr const char* kExamples = R"(Examples:
  allpairs generate uniform -n 100000 -o boxes.npy
  allpairs generate needles -n 50000 --seed 7 --sorted -o needles.npy

The file holds a NumPy array (n, 6), float32: minx miny minz maxx maxy maxz. It is
the same on every machine for the same scene, number, seed and order.)";

/// The start of a NumPy file, version 1.0: the numbers that follow it begin at a multiple of 64 bytes.
std::string npyHeader(std::size_t count) {
  std::string text = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(count) + ", 6), }";
  constexpr std::size_t kBefore = 10;  // Magic, version and the length of the text.
  constexpr std::size_t kAlignment = 64;
  while ((kBefore + text.size() + 1) % kAlignment != 0) text += ' ';
  text += '\n';
  const std::size_t length = text.size();
  const std::string start{
      '\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, static_cast<char>(length % 256), static_cast<char>(length / 256)};
  return start + text;
}

void appendLittleEndian(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xFFU);
}

void writeRows(const std::vector<float>& rows, Output& output) {
  constexpr std::size_t kAtOnce = 65536;
  std::string bytes = npyHeader(rows.size() / 6);
  for (const float value : rows) {
    appendLittleEndian(bytes, value);
    if (bytes.size() < kAtOnce) continue;
    output.write(bytes);
    bytes.clear();
  }
  output.write(bytes);
}

/// A name that promises another format would be a lie.
void checkExtension(const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension.empty() || extension == ".npy") return;
  throw UsageError("-o: '" + path + "': boxes are written as a NumPy array, whose files end in .npy");
}

void runGenerate(const GenerateSettings& settings) {
  checkExtension(settings.output);
  const generate::SceneRequest request = sceneRequest(settings.scene);
  Output output(settings.output.empty() ? std::nullopt : std::optional<std::filesystem::path>(settings.output));
  if (output.isTerminal()) {
    throw UsageError("boxes are binary and not for a terminal: name a file with -o, or redirect the output");
  }
  writeRows(generate::makeBoxes(request), output);
  output.commit();
}

}  // namespace

void addGenerate(CLI::App& program) {
  const auto settings = std::make_shared<GenerateSettings>();
  CLI::App* command = program.add_subcommand("generate", "Make boxes to measure with");
  command->footer(sceneList() + "\n\n" + kExamples);
  command->add_option("SCENE", settings->scene.scene, "Which boxes to make; see below")->required()->type_name("");
  addSceneOptions(*command, settings->scene);
  addOutputOption(*command, settings->output);
  command->callback([settings] { runGenerate(*settings); });
}

}  // namespace allpairs::app
