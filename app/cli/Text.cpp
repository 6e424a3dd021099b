// SPDX-License-Identifier: MIT
#include "cli/Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "allpairs/Error.h"

namespace allpairs::app {

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t position = digits.size(); position > 3;) {
    position -= 3;
    digits.insert(position, 1, ',');
  }
  return digits;
}

std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural) {
  if (count != 1 && !plural.empty()) return fmt::format("{} {}", grouped(count), plural);
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

std::string countedBoxes(std::uint64_t first, std::uint64_t second) {
  return fmt::format("{} and {}", grouped(first), counted(second, "box", "boxes"));
}

std::string printable(const std::string& text) { return escapedControls(text); }

std::string boxText(const Box& box) {
  if (isEmpty(box)) return "empty";
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, {:.6g}]", box.min[0], box.min[1], box.min[2],
                     box.max[0], box.max[1], box.max[2]);
}

std::string lowerExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace allpairs::app
