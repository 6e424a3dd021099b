// SPDX-License-Identifier: MIT
#include "mesh/Faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace allpairs::scene {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Point2 = std::array<double, 2>;

/// For how many pairs a test of a point and a triangle counts: for more than its time. No honest face needs more than
/// some hundred tests a byte, and a megabyte of others is to take seconds, not half a minute.
constexpr std::uint64_t kPairsPerTest = 8;

/// Twice the area of a triangle, negative where it turns clockwise.
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::vector<std::uint32_t> cornersOf(std::span<const Triangle> fan) {
  std::vector<std::uint32_t> corners{fan[0][0], fan[0][1]};
  for (const Triangle& triangle : fan) corners.push_back(triangle[2]);
  return corners;
}

/// The cross product of two sides: it points to where the corners turn counterclockwise, as long as twice the area.
Point crossProduct(std::span<const Point> positions, const Triangle& triangle) {
  const Point& origin = positions[triangle[0]];
  const auto side = [&](std::size_t corner, std::size_t axis) {
    return positions[triangle[corner]][axis] - origin[axis];
  };
  Point product{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    product[axis] = side(1, u) * side(2, v) - side(1, v) * side(2, u);
  }
  return product;
}

/// A view along an axis, from the side where a face turns counterclockwise.
struct Sight {
  std::size_t along = 0;
  bool isFromAbove = true;
};

/// Along the axis that is nearest to the normal of the face.
Sight sightOf(std::span<const Point> positions, std::span<const Triangle> fan) {
  Point normal{};
  for (const Triangle& triangle : fan) {
    const Point product = crossProduct(positions, triangle);
    for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += product[axis];
  }
  std::size_t along = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > std::abs(normal[along])) along = axis;
  }
  return {along, normal[along] >= 0.0};
}

/// Whether no triangle of a fan turns the other way: then they add up to the face, and lie within.
bool isWithinFace(std::span<const Point> positions, std::span<const Triangle> fan, const Sight& sight) {
  return std::all_of(fan.begin(), fan.end(), [&](const Triangle& triangle) {
    const double area = crossProduct(positions, triangle)[sight.along];
    return sight.isFromAbove ? area >= 0.0 : area <= 0.0;
  });
}

std::vector<Point2> flattened(std::span<const Point> positions, std::span<const std::uint32_t> corners,
                              const Sight& sight) {
  const std::size_t u = (sight.along + (sight.isFromAbove ? 1 : 2)) % 3;
  const std::size_t v = (sight.along + (sight.isFromAbove ? 2 : 1)) % 3;
  std::vector<Point2> flat;
  flat.reserve(corners.size());
  for (const std::uint32_t corner : corners) flat.push_back({positions[corner][u], positions[corner][v]});
  return flat;
}

/// Cuts off one ear after the other: a corner that turns left and whose triangle holds no other corner.
class EarCutter {
 public:
  explicit EarCutter(std::vector<Point2> points) : m_points(std::move(points)) {
    const std::size_t size = m_points.size();
    for (std::size_t i = 0; i < size; ++i) {
      m_next.push_back((i + 1) % size);
      m_previous.push_back((i + size - 1) % size);
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (turnAt(i) <= 0.0) m_reflex.push_back(i);
    }
  }

  /// Calls visit(a, b, c) for each triangle, or returns false when it has taken too long.
  template <class Visit>
  [[nodiscard]] bool cut(const Visit& visit) {
    std::size_t corner = 0;
    std::size_t since = 0;  // the last ear
    for (std::size_t left = m_points.size(); left > 3;) {
      if (m_tests > kMostTests) return false;
      const bool isStuck = since > left;  // by rounding, or as the face crosses itself
      if (isStuck) corner = flattest(corner, left);
      if (isStuck || isEar(corner)) {
        visit(m_previous[corner], corner, m_next[corner]);
        corner = remove(corner);
        --left;
        since = 0;
      } else {
        corner = m_next[corner];
        ++since;
      }
    }
    visit(m_previous[corner], corner, m_next[corner]);
    return true;
  }

  /// How many tests of a point and a triangle it took.
  [[nodiscard]] std::uint64_t tests() const { return m_tests; }

 private:
  static constexpr std::uint64_t kMostTests = std::uint64_t{1} << 27;  // of a point and a triangle, half a second

  [[nodiscard]] double turnAt(std::size_t i) const {
    return turn(m_points[m_previous[i]], m_points[i], m_points[m_next[i]]);
  }

  [[nodiscard]] bool isEar(std::size_t i) {
    ++m_tests;
    if (turnAt(i) <= 0.0) return false;
    const Point2& a = m_points[m_previous[i]];
    const Point2& b = m_points[i];
    const Point2& c = m_points[m_next[i]];
    const auto blocking = std::find_if(m_reflex.begin(), m_reflex.end(), [&](std::size_t other) {
      const Point2& p = m_points[other];
      if (p == a || p == b || p == c) return false;  // where an outline touches itself, as around a hole
      return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    });
    m_tests += static_cast<std::uint64_t>(blocking - m_reflex.begin());
    return blocking == m_reflex.end();
  }

  /// Of the `count` corners that are left.
  [[nodiscard]] std::size_t flattest(std::size_t corner, std::size_t count) const {
    std::size_t best = corner;
    for (std::size_t i = 0; i < count; ++i, corner = m_next[corner]) {
      if (std::abs(turnAt(corner)) < std::abs(turnAt(best))) best = corner;
    }
    return best;
  }

  /// Returns the corner to go on at, the second from there: else what is left becomes a fan of needles.
  std::size_t remove(std::size_t i) {
    const std::size_t previous = m_previous[i];
    const std::size_t next = m_next[i];
    m_next[previous] = next;
    m_previous[next] = previous;
    std::erase_if(m_reflex, [&](std::size_t other) {
      return other == i || ((other == previous || other == next) && turnAt(other) > 0.0);
    });
    return m_next[next];
  }

  std::vector<Point2> m_points;
  std::vector<std::size_t> m_next;
  std::vector<std::size_t> m_previous;
  std::uint64_t m_tests = 0;
  std::vector<std::size_t> m_reflex;  ///< The corners that may lie in another's triangle: those that don't turn left.
};

}  // namespace

void addDrawn(MeshObject& object, const std::array<std::uint32_t, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  if (a != b && b != c && c != a) object.triangles.push_back(triangle);
}

void addFace(MeshObject& object, std::span<const std::uint32_t> corners) {
  if (corners.size() == 1) object.points.push_back(corners[0]);
  if (corners.size() == 2) object.lines.push_back({corners[0], corners[1]});
  for (std::size_t i = 2; i < corners.size(); ++i) {
    object.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

std::string cutFan(std::span<const Point> positions, std::span<Triangle> fan, ReadScope& scope) {
  scope.checkStop();
  if (fan.size() < 2) return {};
  const Sight sight = sightOf(positions, fan);
  if (isWithinFace(positions, fan, sight)) return {};
  const std::vector<std::uint32_t> corners = cornersOf(fan);
  auto target = fan.begin();
  EarCutter cutter(flattened(positions, corners, sight));
  const bool isCut = cutter.cut([&](std::size_t a, std::size_t b, std::size_t c) {
    *target++ = {corners[a], corners[b], corners[c]};
  });
  if (!isCut) {
    return "a face of " + std::to_string(corners.size()) + " corners that is too intricate to be cut into triangles";
  }
  if (scope.takeWork(kPairsPerTest * cutter.tests())) return {};
  return "a face up to which cutting faces into triangles takes too long; a larger --max-memory allows more";
}

std::string addCutFace(MeshObject& object, std::span<const std::uint32_t> corners, ReadScope& scope) {
  addFace(object, corners);
  if (corners.size() < 3) return {};
  return cutFan(object.positions, std::span(object.triangles).last(corners.size() - 2), scope);
}

}  // namespace allpairs::scene
