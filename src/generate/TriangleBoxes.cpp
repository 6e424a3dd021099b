// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "Arithmetic.h"
#include "Families.h"
#include "Random.h"

namespace allpairs::generate {

namespace {

using Point = std::array<double, 3>;

/// A torus whose tube swells and shrinks in waves, cut into columns x rows quadrilaterals of two triangles.
struct WavyTorus {
  std::size_t columns = 3;
  std::size_t rows = 3;
  double phase = 0.0;

  [[nodiscard]] Point vertex(std::size_t column, std::size_t row) const {
    const double u = static_cast<double>(column % columns) / static_cast<double>(columns);
    const double v = static_cast<double>(row % rows) / static_cast<double>(rows);
    const auto [cosU, sinU] = cosineAndSine(u);
    const auto [cosV, sinV] = cosineAndSine(v);
    const double wave = cosineAndSine(7.0 * u + 3.0 * v + phase)[1] * cosineAndSine(5.0 * v)[0];
    const double tube = 0.12 * (1.0 + 0.3 * wave);
    const double radius = 0.35 + tube * cosV;
    return {0.5 + radius * cosU, 0.5 + radius * sinU, 0.5 + tube * sinV};
  }

  [[nodiscard]] std::array<Point, 3> triangle(std::size_t index) const {
    const std::size_t quad = index / 2;
    const std::size_t column = quad / rows;
    const std::size_t row = quad % rows;
    const Point diagonalStart = vertex(column, row);
    const Point diagonalEnd = vertex(column + 1, row + 1);
    if (index % 2 == 0) return {diagonalStart, vertex(column + 1, row), diagonalEnd};
    return {diagonalStart, diagonalEnd, vertex(column, row + 1)};
  }
};

WavyTorus torusOf(std::size_t count, std::uint64_t seed) {
  constexpr double kColumnsOfRows = 3.0;  // The torus is about three times as long around as its tube is.
  const double quads = 0.5 * static_cast<double>(count);
  WavyTorus torus;
  torus.rows = std::max<std::size_t>(3, static_cast<std::size_t>(std::sqrt(quads / kColumnsOfRows)));
  torus.columns = std::max<std::size_t>(3, (count / 2 + torus.rows) / torus.rows);
  torus.phase = Random(seed, 0).unit();
  return torus;
}

/// 0 ... count - 1 in an order drawn from the seed, for a mesh's own order is spatial already.
std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t other = Random(seed, i).below(i + 1);
    order[i] = order[other];
    order[other] = i;
  }
  return order;
}

}  // namespace

std::vector<float> triangleBoxes(std::size_t count, std::uint64_t seed) {
  const WavyTorus torus = torusOf(count, seed);
  Rows rows(count);
  for (const std::size_t index : shuffled(count, seed)) {
    const auto [a, b, c] = torus.triangle(index);
    Point min{};
    Point max{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis] = std::min({a[axis], b[axis], c[axis]});
      max[axis] = std::max({a[axis], b[axis], c[axis]});
    }
    rows.add(min, max);
  }
  return std::move(rows).take();
}

}  // namespace allpairs::generate
