// SPDX-License-Identifier: MIT
#include "Flush.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "Inside.h"
#include "Nearest.h"

namespace allpairs::exact {
namespace {

constexpr std::size_t kMostPlaces = 64;
constexpr double kCells = 32.0;                           // along the longest side of all places
constexpr double kWays = 8.0;                             // of directions, on each axis
constexpr std::size_t kMostTests = std::size_t{1} << 21;  // each is a triangle that a ray is tested against

/// How far along a ray a triangle is, infinite if the ray passes it by.
///
/// Reference: T. Möller and B. Trumbore, "Fast, minimum storage ray/triangle intersection", Journal of Graphics Tools 2
/// (1997), 21-28.
double wayTo(const Corners& corners, const Point& from, const Point& direction) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Point u = corners[1] - corners[0];
  const Point v = corners[2] - corners[0];
  const Point across = direction.cross(v);
  const double volume = u.dot(across);
  if (volume == 0.0) return kNever;
  const Point off = from - corners[0];
  const double a = off.dot(across) / volume;
  const Point other = off.cross(u);
  const double b = direction.dot(other) / volume;
  return a < 0.0 || b < 0.0 || a + b > 1.0 ? kNever : v.dot(other) / volume;
}

/// From a place to the next triangle of a part that is not there already.
double wayToNext(const ExactPart& part, const Point& from, const Point& direction, double tolerance) {
  double least = std::numeric_limits<double>::infinity();
  for (const Corners& corners : part.triangles()) {
    const double way = wayTo(corners, from, direction);
    if (way > tolerance) least = std::min(least, way);
  }
  return least;
}

/// Some of the places that lie far apart or face different ways, whatever their order: of many small faces in one plane
/// not so many that they hide a few others.
std::vector<FlushPlace> spread(const std::vector<FlushPlace>& places, std::size_t most) {
  if (places.size() <= most) return places;
  Point least = places.front().point;
  Point greatest = least;
  for (const FlushPlace& place : places) {
    least = least.cwiseMin(place.point);
    greatest = greatest.cwiseMax(place.point);
  }
  const double size = (greatest - least).maxCoeff();
  const bool isOnePoint = size * size == 0.0;
  const double scale = isOnePoint ? 0.0 : kCells / size;
  std::map<std::array<int, 6>, const FlushPlace*> ofCell;  // one of each cell and direction
  for (const FlushPlace& place : places) {
    const Point cell = scale * (place.point - least);
    Eigen::Index axis = 0;
    place.normal.cwiseAbs().maxCoeff(&axis);
    const Point way = (place.normal[axis] < 0.0 ? -kWays : kWays) * place.normal;
    const auto whole = [](double value) { return static_cast<int>(std::lround(value)); };
    ofCell.emplace(
        std::array{whole(cell[0]), whole(cell[1]), whole(cell[2]), whole(way[0]), whole(way[1]), whole(way[2])},
        &place);
  }
  std::vector<std::pair<double, const FlushPlace*>> left;  // and how far the nearest one is that was chosen
  for (const auto& [key, place] : ofCell) left.emplace_back(std::numeric_limits<double>::infinity(), place);
  std::vector<FlushPlace> chosen;
  for (auto next = left.begin(); chosen.size() < most && next->first > 0.0;) {
    chosen.push_back(*next->second);
    for (auto& [apart, place] : left) {
      const double way = isOnePoint ? 0.0 : (place->point - chosen.back().point).squaredNorm() / (size * size);
      apart = std::min(apart, way + 1.0 - std::abs(place->normal.dot(chosen.back().normal)));
    }
    next->first = 0.0;
    next = std::max_element(left.begin(), left.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  return chosen;
}

/// Halfway from some of the places to the next surface of either part, on both sides; in order.
std::vector<Point> pointsBeside(const ExactPart& first, const ExactPart& second, const std::vector<FlushPlace>& places,
                                double tolerance) {
  const std::size_t triangles = first.triangles().size() + second.triangles().size();
  const std::size_t most = std::clamp<std::size_t>(kMostTests / (2 * triangles), 4, kMostPlaces);
  std::vector<Point> points;
  for (const FlushPlace& place : spread(places, most)) {
    for (const Point& direction : {place.normal, Point(-place.normal)}) {
      const double way = std::min(wayToNext(first, place.point, direction, tolerance),
                                  wayToNext(second, place.point, direction, tolerance));
      if (std::isfinite(way)) points.push_back(place.point + (way / 2.0) * direction);
    }
  }
  std::sort(points.begin(), points.end(), isBefore);
  return points;
}

}  // namespace

FlushSides lookBesideFlush(const ExactPart& first, const ExactPart& second, const std::vector<FlushPlace>& places,
                           double tolerance) {
  const std::vector<Point> points = pointsBeside(first, second, places, tolerance);
  const std::vector<Point> inFirst = pointsInside(first, points);
  const std::vector<Point> inSecond = pointsInside(second, points);
  FlushSides sides;
  for (const Point& point : points) {
    const bool isInFirst = std::binary_search(inFirst.begin(), inFirst.end(), point, isBefore);
    const bool isInSecond = std::binary_search(inSecond.begin(), inSecond.end(), point, isBefore);
    if (!isInFirst && !isInSecond) continue;
    const Nearest ofFirst = nearest(first, point);
    const Nearest ofSecond = nearest(second, point);
    if (!isInSecond) {
      sides.isFirstOut = sides.isFirstOut || ofSecond.distance > tolerance;
    } else if (!isInFirst) {
      sides.isSecondOut = sides.isSecondOut || ofFirst.distance > tolerance;
    } else if (const double depth = std::min(ofFirst.distance, ofSecond.distance); depth > sides.common.depth) {
      sides.isOfSecond = ofSecond.distance <= ofFirst.distance;
      const Nearest& nearer = sides.isOfSecond ? ofSecond : ofFirst;
      sides.common = {.found = true, .depth = depth, .point = point, .surface = nearer.onFirst};
    }
  }
  return sides;
}

}  // namespace allpairs::exact
