// SPDX-License-Identifier: MIT
#include "Raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace allpairs::view {
namespace {

/// The first whole number that is not below a value, from 0 to `most`.
std::size_t ceilTo(double value, std::size_t most) {
  if (!(value > 0.0)) return 0;
  if (value >= static_cast<double>(most)) return most;
  const auto whole = static_cast<std::size_t>(value);
  return whole + (static_cast<double>(whole) < value ? 1U : 0U);
}

/// The whole numbers in [low, high] that are in [0, count): first and one past the last.
std::array<std::size_t, 2> cut(double low, double high, std::size_t count) {
  const std::size_t begin = ceilTo(low, count);
  if (!(high >= 0.0)) return {begin, begin};
  const std::size_t end = high >= static_cast<double>(count) ? count : static_cast<std::size_t>(high) + 1;
  return {begin, std::max(begin, end)};
}

double crossAt(const RasterPoint& a, const RasterPoint& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Where an edge of a triangle crosses rows of pixels: the same numbers for both triangles that share it, without a
/// gap.
class Edge {
 public:
  Edge(const RasterPoint& a, const RasterPoint& b) : m_top(a.y < b.y ? a : b) {
    const RasterPoint& bottom = a.y < b.y ? b : a;
    m_bottom = bottom.y;
    m_perRow = (bottom.x - m_top.x) / (bottom.y - m_top.y);
  }

  /// Widens a part of a row to where the edge crosses it, if it does.
  void widen(double y, double& low, double& high) const {
    if (!(y >= m_top.y && y <= m_bottom)) return;
    const double x = m_top.x + (y - m_top.y) * m_perRow;
    low = std::min(low, x);
    high = std::max(high, x);
  }

 private:
  RasterPoint m_top;
  double m_bottom;
  double m_perRow;
};

}  // namespace

Raster::Raster(std::size_t width, std::size_t height, Colour background)
    : m_width(width),
      m_height(height),
      m_pixels(width * height, background),
      m_depths(width * height, std::numeric_limits<float>::infinity()) {}

template <class Paint>
void Raster::scan(const std::array<RasterPoint, 3>& corners, const Paint& paint) const {
  const auto& [a, b, c] = corners;
  const auto [top, bottom] = cut(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), m_height);
  const double left = std::min({a.x, b.x, c.x});
  const double right = std::max({a.x, b.x, c.x});
  const auto [first, last] = cut(left, right, m_width);
  if (top >= bottom || first >= last) return;  // most triangles of a fine mesh meet no pixel's middle
  const double area = crossAt(a, b, c.x, c.y);
  if (!(std::abs(area) > 1e-12)) return;
  const double toB = b.depth - a.depth;
  const double toC = c.depth - a.depth;
  const double depthPerColumn = ((c.y - a.y) * toB - (b.y - a.y) * toC) / area;
  const double depthPerRow = ((b.x - a.x) * toC - (c.x - a.x) * toB) / area;
  const std::array<Edge, 3> edges{Edge(a, b), Edge(b, c), Edge(c, a)};
  for (std::size_t row = top; row < bottom; ++row) {
    const auto y = static_cast<double>(row);
    double low = right;
    double high = left;
    for (const Edge& edge : edges) edge.widen(y, low, high);
    const auto [begin, end] = cut(low, high, m_width);
    double depth = a.depth + depthPerColumn * (static_cast<double>(begin) - a.x) + depthPerRow * (y - a.y);
    for (std::size_t pixel = row * m_width + begin; pixel < row * m_width + end; ++pixel, depth += depthPerColumn)
      paint(pixel, depth);
  }
}

void Raster::triangle(const std::array<RasterPoint, 3>& corners, Colour colour) {
  scan(corners, [depths = m_depths.data(), pixels = m_pixels.data(), colour](std::size_t pixel, double depth) {
    const auto nearer = static_cast<float>(depth);
    if (!(nearer < depths[pixel])) return;
    depths[pixel] = nearer;
    pixels[pixel] = colour;
  });
}

void Raster::veil(const std::array<RasterPoint, 3>& corners, Colour colour, double opacity) {
  scan(corners, [&](std::size_t pixel, double) { mix(pixel, colour, opacity); });
}

void Raster::mix(std::size_t pixel, Colour colour, double opacity) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double mixed = m_pixels[pixel][i] + opacity * (colour[i] - m_pixels[pixel][i]);
    m_pixels[pixel][i] = shade(mixed);
  }
}

void Raster::stamp(const RasterPoint& centre, Colour colour, double radius) {
  constexpr double kHiddenOpacity = 0.06;  // a pixel gets several stamps of a line
  const auto [left, right] = cut(centre.x - radius, centre.x + radius, m_width);
  const auto [top, bottom] = cut(centre.y - radius, centre.y + radius, m_height);
  for (std::size_t y = top; y < bottom; ++y) {
    for (std::size_t x = left; x < right; ++x) {
      const std::size_t pixel = y * m_width + x;
      if (static_cast<double>(m_depths[pixel]) < centre.depth)
        mix(pixel, colour, kHiddenOpacity);
      else
        m_pixels[pixel] = colour;
    }
  }
}

void Raster::line(const RasterPoint& begin, const RasterPoint& end, Colour colour, double width) {
  constexpr double kMostSteps = 20'000.0;  // a line that leaves the picture far behind is drawn coarsely
  const double length = std::max(std::abs(end.x - begin.x), std::abs(end.y - begin.y));
  const double steps = std::clamp(std::ceil(length), 1.0, kMostSteps);
  for (double step = 0.0; step <= steps; ++step) {
    const double t = step / steps;
    const RasterPoint here{begin.x + t * (end.x - begin.x), begin.y + t * (end.y - begin.y),
                           begin.depth + t * (end.depth - begin.depth)};
    stamp(here, colour, width / 2.0);
  }
}

void Raster::paste(const Raster& other, std::size_t left, std::size_t top) {
  const std::size_t columns = std::min(other.m_width, m_width - std::min(left, m_width));
  const std::size_t rows = std::min(other.m_height, m_height - std::min(top, m_height));
  for (std::size_t y = 0; y < rows && columns > 0; ++y)
    std::copy_n(&other.m_pixels[y * other.m_width], columns, &m_pixels[(top + y) * m_width + left]);
}

bool Raster::isSeen(const RasterPoint& point) const {
  const bool isIn = point.x >= 0.0 && point.y >= 0.0 && point.x < static_cast<double>(m_width) &&
                    point.y < static_cast<double>(m_height);
  if (!isIn) return false;
  const std::size_t pixel = static_cast<std::size_t>(point.y) * m_width + static_cast<std::size_t>(point.x);
  return point.depth <= static_cast<double>(m_depths[pixel]);
}

void Raster::halveInto(Raster& result) const {
  std::vector<std::uint16_t> sums(3 * m_width);  // of two rows
  for (std::size_t y = 0; y < result.m_height; ++y) {
    const std::uint8_t* above = m_pixels[2 * y * m_width].data();
    const std::uint8_t* below = above + sums.size();
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = static_cast<std::uint16_t>(above[i] + below[i]);
    Colour* pixel = &result.m_pixels[y * result.m_width];
    for (std::size_t i = 0; i + 5 < sums.size(); i += 6, ++pixel) {
      for (std::size_t part = 0; part < 3; ++part)
        (*pixel)[part] = static_cast<std::uint8_t>((sums[i + part] + sums[i + 3 + part] + 2U) / 4U);
    }
  }
}

void Raster::clear(Colour background) {
  std::fill(m_pixels.begin(), m_pixels.end(), background);
  std::fill(m_depths.begin(), m_depths.end(), std::numeric_limits<float>::infinity());
}

}  // namespace allpairs::view
