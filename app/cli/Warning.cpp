// SPDX-License-Identifier: MIT
#include "cli/Warning.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "cli/Text.h"

namespace allpairs::app {

void warn(const std::string& text, const char* program) {
  if (::isatty(STDERR_FILENO) == 1) std::fputs("\r\033[K", stderr);  // a line that shows progress
  fmt::print(stderr, "{}: warning: {}\n", program, printable(text));
}

std::vector<std::string> emptyTexts(const BoxSetArguments& sets, const std::array<scene::EmptyBoxes, 2>& empty) {
  std::vector<std::string> texts;
  for (std::size_t set = 0; set < empty.size(); ++set) {
    if (empty[set].count == 0) continue;
    const std::vector<std::string>& paths = set == 0 ? sets.paths : sets.with;
    const std::string others = paths.size() == 1 ? "" : fmt::format(" and {} more", paths.size() - 1);
    const std::string inSet = sets.with.empty() ? "" : fmt::format(", in set {}", set + 1);
    const std::string of = paths.size() == 1 ? "" : " of all of them" + inSet;
    texts.push_back(
        fmt::format("{}{}: box {}{}: {}", paths.front(), others, empty[set].first, of, emptyReason(empty[set])));
  }
  return texts;
}

}  // namespace allpairs::app
