// SPDX-License-Identifier: MIT
#include "cli/Arguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "cli/ExitStatus.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

std::optional<double> parseNumber(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto value = numberOf<double>(text);
  return value && !std::isnan(*value) ? value : std::nullopt;
}

std::string describeOrder(const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] < box.max[axis]) continue;
    return std::string("its min must be less than its max on every axis, and is not on ") + "xyz"[axis];
  }
  return {};
}

/// Before what stands behind "--" and begins like an option.
constexpr std::string_view kNoOption = "././";

/// What stands behind "--" is no option. CLI11 knows that before the first input only. "-" is a file's name there.
std::string asPath(std::string_view word) {
  if (word == "-") return "./-";
  return std::string(word.starts_with('-') ? kNoOption : "").append(word);
}

std::array<CLI::Option*, 4> addValues(CLI::App& command, const std::string& prefix, ValueArguments& values) {
  const std::string start = prefix == "--" ? "Files: " : "Files of the second set: ";
  const auto add = [&](const char* name, std::vector<std::string>& files, const char* what) {
    return command.add_option(prefix + name, files, start + what)->type_name("FILE");
  };
  return {add("margins", values.margins, "how far each box extends beyond its bounds"),
          add("groups", values.groups, "each box's group; boxes of one group form no pair, except those of group 0"),
          add("categories", values.categories, "each box's categories, as bits"),
          add("masks", values.masks, "the categories that each box accepts, as bits")};
}

}  // namespace

std::string namesOf(const CLI::Option& option) {
  std::string names = option.get_name(false, true);
  for (std::size_t at = names.find(','); at != std::string::npos; at = names.find(',', at + 1))
    names.insert(at + 1, " ");
  return names;
}

bool isOfFiles(const CLI::Option& option) { return !option.get_positional() && option.get_expected_max() > 1; }

std::string asGiven(const std::string& argument) {
  const bool isMarked = argument.starts_with(kNoOption) && argument.substr(kNoOption.size()).starts_with('-');
  return isMarked ? argument.substr(kNoOption.size()) : argument;
}

std::vector<std::string> joinNumbers(int count, const char* const* arguments) {
  std::vector<std::string> joined;
  for (int i = 1; i < count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--") {
      for (++i; i < count; ++i) joined.push_back(asPath(arguments[i]));
      break;
    }
    joined.emplace_back(argument);
    const bool takesNumbers = argument == "--distance" || argument == "--box" || argument == "--clearance";
    if (takesNumbers && i + 1 < count && !std::string_view(arguments[i + 1]).starts_with("--")) {
      joined.back() += '=';
      joined.back() += arguments[++i];
    }
  }
  return joined;
}

double parseDistance(const std::string& text) {
  const std::optional<double> value = parseNumber(text);
  if (!value || *value == -std::numeric_limits<double>::infinity()) {
    throw UsageError("--distance: '" + text + "' is not a distance");
  }
  return *value;
}

double parseLength(const char* option, const std::string& text) {
  const std::optional<double> value = parseNumber(text);
  if (!value || !std::isfinite(*value) || *value < 0.0)
    throw UsageError(option + (": '" + text) + "' is not a distance from 0 on");
  return *value;
}

std::size_t parseThreads(const std::string& text) {
  constexpr std::size_t kMostDigits = 4;
  const bool isCount = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (!isCount || text.size() > kMostDigits)
    throw UsageError("--threads: '" + text + "' is not a number of threads from 0 to 9999");
  return static_cast<std::size_t>(std::stoul(text));
}

std::uint64_t parseMemory(const std::string& option, const std::string& text) {
  constexpr std::string_view kUnits = "KMGT";
  std::uint64_t value = 0;
  const char* last = text.data() + text.size();
  const auto [end, problem] = std::from_chars(text.data(), last, value);
  const std::size_t unit = end + 1 == last ? kUnits.find(*end) : std::string_view::npos;
  const auto shift = unit == std::string_view::npos ? 0 : 10 * (unit + 1);
  const bool isWhole = end == last || shift != 0;
  if (problem != std::errc() || !isWhole || value == 0 || value > std::numeric_limits<std::uint64_t>::max() >> shift) {
    throw UsageError(option + ": '" + text + "' is not a size, such as 512M or 8G");
  }
  return value << shift;
}

void addBoxSets(CLI::App& command, BoxSetArguments& arguments) {
  const CLI::Option* boxes =
      command.add_option("BOXES", arguments.paths, "One or more .npy files of boxes")->required();
  command.add_option("--with", arguments.with, "Files of a second set: pairs of a box of BOXES and a box of these")
      ->type_name("FILE");
  command.parse_complete_callback([&command, &arguments, boxes] {
    for (const auto* names : {&arguments.paths, &arguments.with}) {
      if (std::find(names->begin(), names->end(), "-") == names->end()) continue;
      throw UsageError("'-': files are read in pieces, more than once, and so not from standard input");
    }
    const std::vector<CLI::Option*>& given = command.parse_order();
    const auto ofFiles =
        std::find_if(given.begin(), given.end(), [](const auto* option) { return isOfFiles(*option); });
    if (std::find(ofFiles, given.end(), boxes) != given.end()) throw UsageError("BOXES " + placeOfBoxes(command));
  });
}

std::string placeOfBoxes(const CLI::App& command) {
  for (const CLI::Option* option : command.parse_order()) {
    if (isOfFiles(*option)) return "come before " + option->get_name() + ", which takes all files that follow it";
  }
  return {};
}

void addBoxValues(CLI::App& command, BoxSetArguments& arguments) {
  command.add_option("--box", arguments.box, "Leave out boxes outside of this region")->type_name("x0,y0,z0,x1,y1,z1");
  addValues(command, "--", arguments.values);
  for (CLI::Option* option : addValues(command, "--with-", arguments.withValues)) {
    for (CLI::Option* other : command.get_options()) {  // to ask for it by its name ends the program where memory does
      if (other->check_lname("with")) option->needs(other);
    }
  }
}

std::vector<std::filesystem::path> pathsOf(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

scene::BoxValueFiles filesOf(const ValueArguments& arguments) {
  return {.margins = pathsOf(arguments.margins),
          .groups = pathsOf(arguments.groups),
          .categories = pathsOf(arguments.categories),
          .masks = pathsOf(arguments.masks)};
}

std::vector<std::filesystem::path> filesOf(const BoxSetArguments& arguments) {
  std::vector<std::filesystem::path> files;
  const auto add = [&files](const std::vector<std::string>& names) {
    files.insert(files.end(), names.begin(), names.end());
  };
  add(arguments.paths);
  add(arguments.with);
  for (const ValueArguments* const values : {&arguments.values, &arguments.withValues}) {
    for (const auto* const names : {&values->margins, &values->groups, &values->categories, &values->masks})
      add(*names);
  }
  return files;
}

Box parseRegion(const std::string& text) {
  std::array<double, 6> values{};
  std::size_t count = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++count) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<double> value = parseNumber(std::string_view(text).substr(begin, end - begin));
    if (!value && text.find(',') == std::string::npos)
      throw UsageError("--box: '" + text + "' is not x0,y0,z0,x1,y1,z1, six numbers with commas between them");
    if (!value) throw UsageError("--box: '" + text.substr(begin, end - begin) + "' in '" + text + "' is not a number");
    if (count < values.size()) values[count] = *value;
    begin = end + 1;
  }
  if (count != values.size()) {
    throw UsageError("--box: '" + text + "' has " + std::to_string(count) + (count == 1 ? " number" : " numbers") +
                     "; x0,y0,z0,x1,y1,z1 are needed");
  }
  const Box box{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
  const std::string problem = describeOrder(box);
  if (!problem.empty()) throw UsageError("--box: '" + text + "': " + problem);
  return box;
}

void checkPairFileName(const std::string& output) {
  const std::string extension = lowerExtension(output);
  if (extension.empty() || extension == ".npy") return;
  throw UsageError("join writes .npy files; the name of its output ends in something else");
}

}  // namespace allpairs::app
