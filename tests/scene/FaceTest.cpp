// SPDX-License-Identifier: MIT
// Faces of many corners are cut into triangles that lie within them, whatever file they come from.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "Expect.h"
#include "allpairs/StopFlag.h"
#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/ReadInput.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Corner = std::array<double, 2>;
using Outline = std::vector<Corner>;
using collision::TriangleModel;

/// Twice the area, by the shoelace formula.
double areaOf(const Outline& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Corner& a = outline[i];
    const Corner& b = outline[(i + 1) % outline.size()];
    area += a[0] * b[1] - a[1] * b[0];
  }
  return area;
}

/// A corner of a flat face in space: upright, lying or on a slope.
std::array<double, 3> inSpace(const Corner& corner, std::size_t plane) {
  const auto [u, v] = corner;
  if (plane == 0) return {u, v, 5.0};
  if (plane == 1) return {5.0, u, v};
  if (plane == 2) return {v, 5.0, u};
  return {u, v, 2.0 - u};  // as long as its shadow on each axis but for a constant factor
}

std::string positionsOf(const Outline& outline, std::size_t plane, const std::string& keyword) {
  std::string text;
  for (const Corner& corner : outline) {
    text += keyword;
    for (const double value : inSpace(corner, plane)) text += ' ' + std::to_string(value);
    text += '\n';
  }
  return text;
}

std::string indices(std::size_t count, std::size_t first) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += ' ' + std::to_string(first + i);
  return text + '\n';
}

using Writer = std::function<std::string(const Outline&, std::size_t)>;

struct Format {
  std::string file;
  Writer write;
};

std::vector<Format> formats() {
  const std::string vertices = "\nproperty double x\nproperty double y\nproperty double z\n";
  const std::string faces = "element face 1\nproperty list uint uint vertex_index\n";
  return {
      {"before.obj",
       [](const Outline& o, std::size_t plane) { return positionsOf(o, plane, "v") + "f" + indices(o.size(), 1); }},
      {"after.obj",
       [](const Outline& o, std::size_t plane) { return "f" + indices(o.size(), 1) + positionsOf(o, plane, "v"); }},
      {"face.off",
       [](const Outline& o, std::size_t plane) {
         const std::string count = std::to_string(o.size());
         return "OFF\n" + count + " 1 0\n" + positionsOf(o, plane, "") + count + indices(o.size(), 0);
       }},
      {"before.ply",
       [=](const Outline& o, std::size_t plane) {
         const std::string count = std::to_string(o.size());
         return "ply\nformat ascii 1.0\nelement vertex " + count + vertices + faces + "end_header\n" +
                positionsOf(o, plane, "") + count + indices(o.size(), 0);
       }},
      {"after.ply",
       [=](const Outline& o, std::size_t plane) {
         const std::string count = std::to_string(o.size());
         return "ply\nformat ascii 1.0\n" + faces + "element vertex " + count + vertices + "end_header\n" + count +
                indices(o.size(), 0) + positionsOf(o, plane, "");
       }},
  };
}

std::vector<TriangleModel::Triangle> trianglesOf(const std::string& file, const std::string& text) {
  const TempFolder folder;
  const scene::Scene scene = scene::readInput(folder.write(file, text));
  return dynamic_cast<const TriangleModel&>(*scene.models.at(0)).triangles();
}

/// Triangles with the corners of an outline fill it, each place once, if their areas without a sign have its sum:
/// with the sign any that share their inner edges have. Files have six decimals.
void expectFilled(const Outline& outline, const std::vector<TriangleModel::Triangle>& triangles) {
  ASSERT_EQ(triangles.size(), outline.size() - 2);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) sum += std::abs(areaOf({outline[a], outline[b], outline[c]}));
  EXPECT_NEAR(sum, std::abs(areaOf(outline)), 1e-6 * sum);
}

/// The same outline from another corner on, or the other way round.
Outline turned(Outline outline, std::size_t first, bool isReversed) {
  std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(first), outline.end());
  if (isReversed) std::reverse(outline.begin(), outline.end());
  return outline;
}

const std::vector<Outline> kOutlines = {
    {{3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}},                                                  // an L
    {{0, 0}, {4, 0}, {1, 1}, {0, 4}},                                                                  // an arrow
    {{0, 0}, {7, 0}, {7, 5}, {6, 5}, {6, 1}, {5, 1}, {5, 5}, {4, 5}, {4, 1}, {3, 1}, {3, 5}, {0, 5}},  // a comb
    {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 2}, {7, 2}, {7, 7}, {2, 7}, {2, 4}, {5, 4},
     {5, 5}, {3, 5}, {3, 6}, {6, 6}, {6, 3}, {1, 3}, {1, 8}, {8, 8}, {8, 1}, {0, 1}},  // a spiral
    {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}},  // a square with a hole
    {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 1}, {1, 1}, {0, 3}},                  // corners on a straight line
};

TEST(Faces, ThatAreNotConvexAreFilledByTheirTrianglesInEveryFormat) {
  for (const Outline& shape : kOutlines) {
    for (std::size_t first = 0; first < shape.size(); ++first) {
      const Outline outline = turned(shape, first, first % 2 == 1);
      std::size_t plane = first;
      for (const Format& format : formats()) {
        SCOPED_TRACE(format.file + " in plane " + std::to_string(plane % 4) + " from corner " + std::to_string(first));
        expectFilled(outline, trianglesOf(format.file, format.write(outline, plane++ % 4)));
      }
    }
  }
}

TEST(Faces, OfFourCornersAreFilledFromWhicheverCornerTheyBegin) {
  const Outline arrow{{0, 0}, {4, 0}, {1, 1}, {0, 4}};
  for (std::size_t first = 0; first < arrow.size(); ++first) {
    for (const bool isReversed : {false, true}) {
      const Outline outline = turned(arrow, first, isReversed);
      for (const Format& format : formats()) {
        SCOPED_TRACE(format.file + " from corner " + std::to_string(first) + (isReversed ? ", reversed" : ""));
        expectFilled(outline, trianglesOf(format.file, format.write(outline, 0)));
      }
    }
  }
}

/// Corners at random distances around a point within, which no two sides cross.
Outline star(std::mt19937& random, std::size_t size) {
  std::uniform_real_distribution<double> radius(0.05, 4.0);
  Outline outline;
  for (std::size_t i = 0; i < size; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(size);
    const double r = radius(random);
    outline.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return outline;
}

TEST(Faces, StarsOfManyCornersAreFilled) {
  std::mt19937 random(7);
  const Format obj = formats()[0];
  for (const std::size_t size : {4U, 5U, 6U, 9U, 17U, 40U, 151U}) {
    for (int i = 0; i < 40; ++i) {
      const Outline outline = turned(star(random, size), random() % size, i % 2 == 0);
      expectFilled(outline, trianglesOf(obj.file, obj.write(outline, static_cast<std::size_t>(i) % 4)));
    }
  }
}

TEST(Faces, ThatAreConvexAreFansFromTheirFirstCorner) {
  const Format obj = formats()[0];
  EXPECT_EQ(trianglesOf(obj.file, obj.write({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}, 0)),
            (std::vector<TriangleModel::Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Faces, OfAnyCornersHaveTheirTriangles) {
  const Outline crossing{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  const Outline points(6, Corner{1, 1});
  const Outline line{{0, 0}, {3, 0}, {1, 0}, {2, 0}, {5, 0}};
  for (const Outline& outline : {crossing, points, line}) {
    for (const Format& format : formats()) {
      const auto triangles = trianglesOf(format.file, format.write(outline, 0));
      EXPECT_EQ(triangles.size(), outline.size() - 2) << format.file;
    }
  }
}

/// Two arms, one between the turns of the other, so that only their ends can be cut off.
Outline spiral(std::size_t size) {
  Outline outline;
  for (std::size_t i = 0; i < size; ++i) {
    const double angle = 0.3 * static_cast<double>(i);
    outline.push_back({(1.0 + angle) * std::cos(angle), (1.0 + angle) * std::sin(angle)});
  }
  for (std::size_t i = size; i-- > 0;) {
    const double angle = 0.3 * static_cast<double>(i);
    outline.push_back({(2.0 + angle) * std::cos(angle), (2.0 + angle) * std::sin(angle)});
  }
  return outline;
}

TEST(Faces, OfThousandsOfCornersAreFilledOrRefused) {
  std::mt19937 random(7);
  const Format obj = formats()[0];
  for (const Outline& outline : {star(random, 4000), spiral(300)}) {
    expectFilled(outline, trianglesOf(obj.file, obj.write(outline, 0)));
  }
  const TempFolder folder;
  for (const Format& format : formats()) {
    if (format.file.starts_with("after")) continue;
    // To give up takes as long for each format, and ten seconds under a sanitizer: of others than OBJ sooner then.
    const bool isSooner = kIsSanitized && format.file != "before.obj";
    scene::ReadOptions options;
    if (isSooner) options.maxMemory = std::uint64_t{1} << 20;
    const auto path = folder.write(format.file, format.write(spiral(isSooner ? 400 : 15000), 0));
    expectFileError([&] { (void)scene::readInput(path, options); },
                    isSooner ? "a face up to which cutting faces into triangles takes too long"
                             : "a face of 30000 corners that is too intricate");
  }
}

TEST(Faces, ThatAreHardToCutAreBoundedTogether) {
  constexpr std::size_t kSize = kIsSanitized ? 300 : 600;  // a half takes an eighth of the tests
  const std::string vertices = positionsOf(spiral(kSize), 0, "v");
  const std::string face = "f" + indices(2 * kSize, 1);
  const TempFolder folder;
  scene::ReadOptions options;
  options.maxMemory = std::uint64_t{kIsSanitized ? 2 : 16} << 20;
  std::string faces;
  for (int i = 0; i < 15; ++i) faces += face;
  EXPECT_EQ(scene::readInput(folder.write("a.obj", vertices + face), options).models.size(), 1U);
  for (const std::string& text : {vertices + faces, faces + vertices}) {
    expectFileError([&, path = folder.write("a.obj", text)] { (void)scene::readInput(path, options); },
                    "a face up to which cutting faces into triangles takes too long; a larger --max-memory");
  }
}

TEST(Faces, AStopEndsTheCutting) {
  const std::string face = "f" + indices(4, 1);
  const auto asksOf = [&](std::size_t faces) {
    const TempFolder folder;
    std::string text;
    for (std::size_t i = 0; i < faces; ++i) text += face;
    std::size_t asked = 0;
    const auto ask = [&asked] { return ++asked == 0; };
    const StopFlag stop(ask);
    scene::ReadOptions options;
    options.stop = &stop;
    (void)scene::readInput(folder.write("a.obj", text + positionsOf({{0, 0}, {4, 0}, {1, 1}, {0, 4}}, 0, "v")),
                           options);
    return asked;
  };
  EXPECT_GE(asksOf(200) - asksOf(100), 200U) << "once where a face is read, once where it is cut";
}

TEST(Faces, OfThousandsOfCornersThatAreConvexAreRead) {
  Outline round;
  for (int i = 0; i < 20000; ++i) round.push_back({1e5 * std::cos(i * 0.000314), 1e5 * std::sin(i * 0.000314)});
  EXPECT_EQ(trianglesOf("round.obj", formats()[0].write(round, 0)).size(), 19998U);
}

}  // namespace
}  // namespace allpairs::test
