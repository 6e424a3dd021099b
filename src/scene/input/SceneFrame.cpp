// SPDX-License-Identifier: MIT
#include "input/SceneFrame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace allpairs::scene {
namespace {

constexpr double kRounding = 1e-6;  // of a float32 that was converted

std::string axisText(int up) { return std::string(up < 0 ? "-" : "") + static_cast<char>('x' + std::abs(up) - 1); }

std::string metresText(double metres) {
  const std::string text = fmt::format("{:.6g} metre", metres);
  return text == "1 metre" ? text : text + 's';
}

bool areSame(double a, double b) { return std::abs(a - b) <= kRounding * std::abs(a); }

}  // namespace

void noteFrame(Scene& scene, const std::filesystem::path& file, int up, std::optional<double> metresPerUnit) {
  const auto warn = [&](const char* subject, const std::string& own, const std::string& others) {
    const auto isKnown = [&](const Remark& warning) { return warning.subject == subject; };
    if (std::any_of(scene.warnings.begin(), scene.warnings.end(), isKnown)) return;  // once for all files
    scene.warnings.push_back(
        {.file = file,
         .subject = subject,
         .reason = fmt::format("{} in this file, {} in a file before it; coordinates are compared as they are", own,
                               others)});
  };
  if (scene.frameFile.empty() && (up != 0 || metresPerUnit)) scene.frameFile = file;
  if (up != 0 && scene.up != 0 && up != scene.up) warn("axes", axisText(up) + " points up", axisText(scene.up));
  if (scene.up == 0) scene.up = up;
  if (metresPerUnit && scene.metresPerUnit && !areSame(*metresPerUnit, *scene.metresPerUnit)) {
    warn("unit", metresText(*metresPerUnit), metresText(*scene.metresPerUnit));
  }
  if (!scene.metresPerUnit) scene.metresPerUnit = metresPerUnit;
}

}  // namespace allpairs::scene
