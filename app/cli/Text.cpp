// SPDX-License-Identifier: MIT
#include "cli/Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "allpairs/Error.h"

namespace allpairs::app {

std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural) {
  if (count != 1 && !plural.empty()) return fmt::format("{} {}", grouped(count), plural);
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

std::string mebibytes(std::uint64_t bytes) { return grouped((bytes >> 20) + 1) + " MiB"; }

std::string countedBoxes(std::uint64_t first, std::uint64_t second) {
  return fmt::format("{} and {}", grouped(first), counted(second, "box", "boxes"));
}

std::string printable(const std::string& text) { return escapedControls(text); }

std::string betweenQuotes(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result;
}

std::string shellWord(const std::string& text) {
  if (text.starts_with('-')) return shellWord("./" + text);
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=@%+";
  const auto isPlain = [&kPlain](char c) {
    return static_cast<unsigned char>(c) >= 0x80 || kPlain.find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), isPlain)) return text;
  return '\'' + betweenQuotes(text) + '\'';
}

std::string coordinateText(double value) {
  constexpr int kFewestDigits = 6;
  constexpr double kMost = 1e12;
  int digits = kFewestDigits;
  for (double limit = 1e4; limit <= std::abs(value) && std::abs(value) < kMost; limit *= 10.0) ++digits;
  return fmt::format("{:.{}g}", value, digits);
}

std::string boxText(const Box& box) {
  if (isEmpty(box)) return "empty";
  const auto corner = [](const std::array<double, 3>& point) {
    return fmt::format("[{}, {}, {}]", coordinateText(point[0]), coordinateText(point[1]), coordinateText(point[2]));
  };
  return corner(box.min) + " to " + corner(box.max);
}

std::string lowerExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace allpairs::app
