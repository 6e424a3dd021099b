// SPDX-License-Identifier: MIT
// Assemblies with known clashes: gears that mesh, a pipe through a beam, two identical screws.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/Expect.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Point2 = std::array<double, 2>;
using Outline = std::vector<Point2>;
constexpr double kPi = std::numbers::pi;

/// A star-shaped outline from z = low to high as a closed mesh: walls, and caps around a point within.
std::string extruded(const std::string& name, const Outline& outline, Point2 within, double low, double high) {
  std::ostringstream text;
  text.precision(17);
  text << "o " << name << '\n';
  for (const double z : {low, high}) {
    for (const Point2& p : outline) text << "v " << p[0] << ' ' << p[1] << ' ' << z << '\n';
  }
  for (const double z : {low, high}) text << "v " << within[0] << ' ' << within[1] << ' ' << z << '\n';
  const int n = static_cast<int>(outline.size());
  const int all = 2 * n + 2;  // vertices are counted from the last one
  for (int i = 0; i < n; ++i) {
    const int at = i - all;
    const int next = (i + 1) % n - all;
    text << "f " << at << ' ' << next << ' ' << n + next << ' ' << n + at << '\n';
    text << "f " << next << ' ' << at << " -2\nf " << n + at << ' ' << n + next << " -1\n";
  }
  return text.str();
}

/// A gear of 12 teeth with outer radius 11 and root radius 9, the middle of a tooth at `angle`.
Outline gear(Point2 centre, double angle) {
  constexpr int kTeeth = 12;
  Outline outline;
  for (int tooth = 0; tooth < kTeeth; ++tooth) {
    for (const auto& [part, radius] : {std::pair{-0.3, 9.0}, {-0.15, 11.0}, {0.15, 11.0}, {0.3, 9.0}}) {
      const double at = angle + 2.0 * kPi * (tooth + part) / kTeeth;
      outline.push_back({centre[0] + radius * std::cos(at), centre[1] + radius * std::sin(at)});
    }
  }
  return outline;
}

double distanceTo(const Outline& outline, const Point2& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point2& a = outline[i];
    const Point2& b = outline[(i + 1) % outline.size()];
    const Point2 along{b[0] - a[0], b[1] - a[1]};
    const double part =
        ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / (along[0] * along[0] + along[1] * along[1]);
    const double t = std::clamp(part, 0.0, 1.0);
    least = std::min(least, std::hypot(a[0] + t * along[0] - p[0], a[1] + t * along[1] - p[1]));
  }
  return least;
}

bool isIn(const Outline& outline, const Point2& p) {
  bool result = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point2& a = outline[i];
    const Point2& b = outline[(i + 1) % outline.size()];
    const bool crosses = (a[1] > p[1]) != (b[1] > p[1]);
    if (crosses && p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1])) result = !result;
  }
  return result;
}

constexpr int kPointsPerLine = kIsSanitized ? 400 : 2000;  // lines are about 2 long
constexpr double kAccuracy = 2.0 / kPointsPerLine;

/// How deep one outline lies in the other, and how far it is from it, by many points of its lines.
std::array<double, 2> depthAndDistance(const Outline& a, const Outline& b) {
  double depth = 0.0;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point2& from = a[i];
    const Point2& to = a[(i + 1) % a.size()];
    for (int k = 0; k < kPointsPerLine; ++k) {
      const double t = static_cast<double>(k) / kPointsPerLine;
      const Point2 p{from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
      const double away = distanceTo(b, p);
      distance = std::min(distance, away);
      if (isIn(b, p)) depth = std::max(depth, away);
    }
  }
  return {depth, distance};
}

/// What detect says of the only two models of a file whose boxes overlap.
nlohmann::json examined(const TempFolder& folder, const std::string& text) {
  const std::string input = folder.write("assembly.obj", text);
  const ProgramRun run = runProgram({"detect", input, "--exact", "--format", "json"});
  expectSuccess(run);
  const auto result = nlohmann::json::parse(run.out);
  EXPECT_EQ(result["exact"].size(), 1U);
  return result["exact"][0];
}

TEST(Assemblies, GearsThatMeshAreApartAndClashWhenOneIsTurned) {
  const TempFolder folder;
  const Outline first = gear({0.0, 0.0}, 0.0);
  const double pitch = 2.0 * kPi / 12;
  for (const double turn : {0.5, 0.52, 0.3, 0.1, 0.0}) {  // of a pitch; at a half a tooth is in a gap
    const Outline second = gear({20.3, 0.0}, kPi + turn * pitch);
    const auto pair = examined(
        folder, extruded("one", first, {0.0, 0.0}, -5.0, 5.0) + extruded("other", second, {20.3, 0.0}, -5.0, 5.0));
    const auto [depth, distance] = depthAndDistance(first, second);
    const auto [back, other] = depthAndDistance(second, first);
    const double deepest = std::max(depth, back);
    if (deepest == 0.0) {
      EXPECT_EQ(pair["state"], "apart") << turn;
      EXPECT_NEAR(pair["distance"].get<double>(), std::min(distance, other), kAccuracy) << turn;
      continue;
    }
    EXPECT_EQ(pair["state"], "clash") << turn;
    EXPECT_LE(pair["depth"].get<double>(), deepest + kAccuracy) << turn;
    EXPECT_GE(pair["depth"].get<double>(), 0.9 * deepest) << turn;
  }
}

Outline circle(Point2 centre, double radius) {
  Outline outline;
  constexpr int kCorners = 64;
  for (int i = 0; i < kCorners; ++i) {
    const double at = 2.0 * kPi * i / kCorners;
    outline.push_back({centre[0] + radius * std::cos(at), centre[1] + radius * std::sin(at)});
  }
  return outline;
}

TEST(Assemblies, APipeThroughABeamIsAsDeepAsItsMiddle) {
  const TempFolder folder;
  const Outline beam{{-10.0, -1.0}, {10.0, -1.0}, {10.0, 1.0}, {-10.0, 1.0}};
  const std::string text = extruded("beam", beam, {0.0, 0.0}, -1.0, 1.0);
  const auto through = examined(folder, text + extruded("pipe", circle({3.0, 0.0}, 0.5), {3.0, 0.0}, -6.0, 6.0));
  EXPECT_EQ(through["state"], "clash");
  EXPECT_NEAR(through["depth"].get<double>(), 1.0,
              1e-9);  // half way along it, at its sides, from all four faces of the beam
  const auto beside = examined(folder, text + extruded("pipe", circle({3.0, 1.25}, 0.5), {3.0, 1.25}, -6.0, 6.0));
  EXPECT_EQ(beside["state"], "clash");
  EXPECT_NEAR(beside["depth"].get<double>(), 0.25, 1e-9);
  const auto touching = examined(folder, text + extruded("pipe", circle({3.0, 1.5}, 0.5), {3.0, 1.5}, -6.0, 6.0));
  EXPECT_EQ(touching["state"], "touching");
}

/// A screw: a shaft of radius 1 and length 10 with a head of radius 2, as one body of revolution around z.
std::string screw(const std::string& name, double x) {
  const std::vector<Point2> profile{{1.0, 0.0}, {1.0, 10.0}, {2.0, 10.0}, {2.0, 12.0}};
  std::ostringstream text;
  text.precision(17);
  text << "o " << name << '\n';
  for (const Point2& ring : profile) {
    for (const Point2& p : circle({x, 0.0}, ring[0])) text << "v " << p[0] << ' ' << p[1] << ' ' << ring[1] << '\n';
  }
  const int corners = static_cast<int>(circle({0.0, 0.0}, 1.0).size());
  for (int ring = 0; ring + 1 < 4; ++ring) {
    for (int i = 0; i < corners; ++i) {
      const int a = (ring - 4) * corners + i;
      const int b = (ring - 4) * corners + (i + 1) % corners;
      text << "f " << a << ' ' << b << ' ' << b + corners << ' ' << a + corners << '\n';
    }
  }
  text << 'f';
  for (int i = corners - 1; i >= 0; --i) text << ' ' << i - 4 * corners;
  text << "\nf";
  for (int i = 0; i < corners; ++i) text << ' ' << i - corners;
  return text.str() + '\n';
}

TEST(Assemblies, TwoIdenticalScrewsAreADuplicateAndComeFirst) {
  const TempFolder folder;
  const std::string input =
      folder.write("screws.obj", screw("screw", 0.0) + screw("copy", 0.0) + screw("near", 3.5) + screw("far", 7.6));
  const auto result = nlohmann::json::parse(runProgram({"detect", input, "--exact", "--format", "json"}).out);
  std::multiset<std::string> states;
  for (const auto& pair : result["exact"]) states.insert(pair["state"].get<std::string>());
  EXPECT_EQ(states, (std::multiset<std::string>{"duplicate", "clash", "clash"}));
  const std::string table = runProgram({"detect", input, "--exact"}).out;
  EXPECT_LT(table.find("duplicate"), table.find("\n  clash"));
  for (const auto& pair : result["exact"]) {
    if (pair["state"] == "clash") {
      EXPECT_NEAR(pair["depth"].get<double>(), 0.5, 0.01) << "heads of radius 2, 3.5 apart";
    }
  }
}

}  // namespace
}  // namespace allpairs::test
