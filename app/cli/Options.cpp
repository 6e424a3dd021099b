// SPDX-License-Identifier: MIT
#include "cli/Options.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Error.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "allpairs/Error.h"
#include "allpairs/scene/ReadOptions.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

/// What is wrong with the value of --sofa; nothing for a version.
std::string problemOfSofa(const std::string& text) {
  try {
    static_cast<void>(scene::sofaVersionOf(text));
  } catch (const InvalidArgument& problem) {
    return problem.what();
  }
  return {};
}

}  // namespace

void addReadLimits(CLI::App& command, ReadLimits& limits) {
  command.add_flag("--allow-outside", limits.allowOutside, "Let inputs name files outside of their own folders");
  command
      .add_option(
          "--max-memory", limits.maxMemory,
          "Read within so much memory; by default 256M and 256 bytes for each byte of the files, at most half of "
          "the machine's")
      ->type_name("SIZE");
  command
      .add_option("--input-format", limits.inputFormat,
                  "What standard input (-) and pipes hold, as a file's extension: npy, csv, obj, stl, ...")
      ->type_name("EXT")
      ->check([](const std::string& text) {
        const bool isWord =
            !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789") == std::string::npos;
        return isWord ? std::string() : "'" + text + "' is no extension of a file, such as npy";
      });
}

void addBetweenInputs(CLI::App& command, InputSettings& settings) {
  command.add_flag("--between-inputs", settings.betweenInputs, "Leave out pairs of two models of the same input");
}

void addInputs(CLI::App& command, InputSettings& settings) {
  command.add_option("INPUT", settings.paths, "Scenes, meshes, folders of meshes, box arrays; taken together")
      ->required()
      ->type_name("");
  command.add_flag("--recursive", settings.recursive, "Of a folder, also read the meshes of the folders within it");
  command.add_flag("--partial", settings.partial, "Ignore what cannot be placed or read");
  command
      .add_option("--data", settings.searchRoots, "Also search this folder for files that a scene names; repeatable")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  command
      .add_option("--sofa", settings.sofa,
                  "Read scenes as this SOFA does, up to 20.06 or from 22.06 on; by default as one that knows their "
                  "components")
      ->type_name("20.06|26.12")
      ->check(problemOfSofa);
  addReadLimits(command, settings.limits);
}

CLI::Option* addChoice(CLI::App& command, const std::string& name, std::string& value,
                       const std::vector<std::string>& choices) {
  const auto check = [choices](const std::string& text) {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return std::string();
    return fmt::format("'{}' is not one of {}", text, fmt::join(choices, ", "));
  };
  return command.add_option(name, value)->type_name(fmt::format("{}", fmt::join(choices, "|")))->check(check);
}

CLI::Option* addDistance(CLI::App& command, std::string& distance, const std::string& description) {
  return command.add_option("--distance", distance, description)->type_name("D");
}

CLI::Option* addThreads(CLI::App& command, std::string& threads) {
  return command.add_option("--threads", threads, "Number of threads; 0: one per core")
      ->type_name("N")
      ->capture_default_str();
}

void takeCount(CLI::Option& option) {
  option.transform([&option](const std::string& text) {
    if (numberOf<std::uint64_t>(text)) return text;
    constexpr double kMost = 1e15;  // float64 holds every whole number up to it
    const double value = numberOf<double>(text).value_or(-1.0);
    if (!(value >= 0.0) || std::floor(value) != value)
      throw UsageError(namesOf(option) + ": '" + text + "' is not a whole number from 0 on");
    if (value > kMost) throw UsageError(namesOf(option) + ": '" + text + "' is too large");
    return fmt::format("{:.0f}", value);
  });
}

void takeNumber(CLI::Option& option, std::uint64_t least, std::uint64_t most) {
  option.check([least, most](const std::string& text) {
    const auto value = numberOf<std::uint64_t>(text);
    if (value && *value >= least && *value <= most) return std::string();
    return fmt::format("'{}' is not a whole number from {} to {}", text, least, most);
  });
}

void addStrategy(CLI::App& command, std::string& strategy) {
  addChoice(command, "--strategy", strategy, {"auto", "exhaustive", "bvh"})
      ->description("Algorithm; all give the same pairs")
      ->capture_default_str();
}

void addFormat(CLI::App& command, std::string& format, const std::vector<std::string>& formats) {
  addChoice(command, "--format", format, formats)
      ->description(
          fmt::format("Output format; default: by the extension of FILE; {} for .txt and for none", formats.front()));
}

std::string formatOf(const std::string& format, const std::string& output, const std::vector<std::string>& formats) {
  if (!format.empty()) return format;
  const std::string extension = lowerExtension(output);
  const auto named = std::find_if(formats.begin() + 1, formats.end(),
                                  [&extension](const std::string& name) { return extension == '.' + name; });
  if (named != formats.end()) return *named;
  if (extension.empty() || extension == ".txt") return formats.front();
  throw UsageError(
      fmt::format("-o: '{}' ends in no format that can be written, which are .txt, .{}; --format says which "
                  "one it is",
                  output, fmt::join(formats.begin() + 1, formats.end(), ", .")));
}

CLI::Option* addOutput(CLI::App& command, std::string& path) {
  return command.add_option("-o,--output", path, "Write to FILE, which appears only when complete; -: standard output")
      ->type_name("FILE")
      ->transform([](const std::string& text) { return text == "-" ? std::string() : text; });
}

std::optional<std::filesystem::path> targetOf(const std::string& path) {
  return path.empty() ? std::nullopt : std::optional<std::filesystem::path>(path);
}

}  // namespace allpairs::app
