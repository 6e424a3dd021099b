// SPDX-License-Identifier: MIT
#include "view/ViewBoxes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "cli/Text.h"
#include "input/Inputs.h"

namespace allpairs::app {

namespace flag = view::flag;

namespace {

/// The last name of a path; that of "." or ".." is the folder's, wherever one is.
std::string lastNameOf(const std::filesystem::path& path) {
  std::filesystem::path clean = path.lexically_normal();
  if (!clean.has_filename()) clean = clean.parent_path();  // of "parts/"
  const std::filesystem::path name = clean.filename();
  if (name != "." && name != "..") return name.string();
  std::error_code problem;
  const std::filesystem::path whole = std::filesystem::canonical(path, problem);
  return problem || !whole.has_filename() ? name.string() : whole.filename().string();
}

}  // namespace

std::string titleOf(const InputSettings& input) {
  std::vector<std::string> names;
  for (const std::string& path : input.paths) names.push_back(lastNameOf(shownPath(input, path)));
  constexpr std::size_t kShown = 3;
  if (names.size() <= kShown) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", names.front(), names.size() - 1);
}

void addBoxColumns(std::size_t count, view::ViewScene& to) {
  to.modelCount = count;
  to.typeNames = {"BoxModel"};
  to.groupSets = {{}};
  to.types.assign(count, 0);
  to.groups.assign(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) to.owners.push_back(i);
  to.elements.assign(count, 1);
  to.contactDistances.assign(count, 0.0);
}

view::ViewFrame boxFrame(const BoxView& boxes, const DetectionOptions& options) {
  view::ViewFrame frame;
  const double distance = options.distance.value_or(0.0);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box box = boxes[i];
    const bool isOutside = options.region && !overlap(*options.region, box, distance);
    const unsigned flags = flag::kActive | flag::kSimulated | flag::kMoving | (isOutside ? flag::kOutside : 0U);
    frame.boxes.push_back(box);
    frame.flags.push_back(static_cast<std::uint8_t>(flags));
  }
  return frame;
}

}  // namespace allpairs::app
