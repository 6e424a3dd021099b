// SPDX-License-Identifier: MIT
#include "view/ViewBoxes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "cli/Text.h"
#include "input/Inputs.h"

namespace allpairs::app {

namespace flag = view::flag;

std::string titleOf(const InputSettings& input) {
  std::vector<std::string> names;
  for (const std::string& path : input.paths) {
    const std::filesystem::path clean = shownPath(input, path).lexically_normal();
    names.push_back((clean.has_filename() ? clean : clean.parent_path()).filename().string());
  }
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
