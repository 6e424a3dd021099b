// SPDX-License-Identifier: MIT
#include "cli/Warning.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/Text.h"

namespace allpairs::app {

void warn(const std::string& text, const char* program) {
  fmt::print(stderr, "{}: warning: {}\n", program, printable(text));
}

std::string emptyReason(const scene::EmptyBoxes& boxes) {
  std::string reason = fmt::format("min above max on {}", "xyz"[boxes.axis]);
  if (boxes.count > 1) reason += " (and " + counted(boxes.count - 1, "other box", "other boxes") + ")";
  return reason + ": empty, in no pair";
}

std::vector<std::string> emptyTexts(const BoxSetArguments& sets, const std::array<scene::EmptyBoxes, 2>& empty) {
  std::vector<std::string> texts;
  for (std::size_t set = 0; set < empty.size(); ++set) {
    if (empty[set].count == 0) continue;
    const std::vector<std::string>& paths = set == 0 ? sets.paths : sets.with;
    const std::string file = paths.size() == 1 ? paths.front() + ": " : "";
    const std::string of = sets.with.empty() || paths.size() == 1 ? "" : fmt::format(" of set {}", set + 1);
    texts.push_back(fmt::format("{}box {}{}: {}", file, empty[set].first, of, emptyReason(empty[set])));
  }
  return texts;
}

}  // namespace allpairs::app
