// SPDX-License-Identifier: MIT
#include "Raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace allpairs::view {
namespace {

/// The whole numbers in [low, high] that are in [0, count): first and one past the last.
std::array<std::size_t, 2> cut(double low, double high, std::size_t count) {
  const auto most = static_cast<double>(count);
  const double begin = std::clamp(std::ceil(low), 0.0, most);
  const double end = std::clamp(std::floor(high) + 1.0, begin, most);
  return {static_cast<std::size_t>(begin), static_cast<std::size_t>(end)};
}

double crossAt(const RasterPoint& a, const RasterPoint& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

Raster::Raster(std::size_t width, std::size_t height, Colour background)
    : m_width(width),
      m_height(height),
      m_pixels(width * height, background),
      m_depths(width * height, std::numeric_limits<float>::infinity()) {}

template <class Paint>
void Raster::scan(const std::array<RasterPoint, 3>& corners, const Paint& paint) const {
  const auto& [a, b, c] = corners;
  const double area = crossAt(a, b, c.x, c.y);
  if (!(std::abs(area) > 1e-12)) return;
  const auto [left, right] = cut(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), m_width);
  const auto [top, bottom] = cut(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), m_height);
  for (std::size_t y = top; y < bottom; ++y) {
    for (std::size_t x = left; x < right; ++x) {
      const auto px = static_cast<double>(x);
      const auto py = static_cast<double>(y);
      const double u = crossAt(b, c, px, py) / area;
      const double v = crossAt(c, a, px, py) / area;
      const double w = 1.0 - u - v;
      if (u >= 0.0 && v >= 0.0 && w >= 0.0) paint(y * m_width + x, u * a.depth + v * b.depth + w * c.depth);
    }
  }
}

void Raster::triangle(const std::array<RasterPoint, 3>& corners, Colour colour) {
  scan(corners, [&](std::size_t pixel, double depth) {
    const auto nearer = static_cast<float>(depth);
    if (!(nearer < m_depths[pixel])) return;
    m_depths[pixel] = nearer;
    m_pixels[pixel] = colour;
  });
}

void Raster::veil(const std::array<RasterPoint, 3>& corners, Colour colour, double opacity) {
  scan(corners, [&](std::size_t pixel, double) { mix(pixel, colour, opacity); });
}

void Raster::mix(std::size_t pixel, Colour colour, double opacity) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double mixed = m_pixels[pixel][i] + opacity * (colour[i] - m_pixels[pixel][i]);
    m_pixels[pixel][i] = static_cast<std::uint8_t>(std::lround(mixed));
  }
}

void Raster::stamp(const RasterPoint& centre, Colour colour, double radius) {
  constexpr double kHiddenOpacity = 0.06;  // a pixel gets several stamps of a line
  const auto [left, right] = cut(centre.x - radius, centre.x + radius, m_width);
  const auto [top, bottom] = cut(centre.y - radius, centre.y + radius, m_height);
  for (std::size_t y = top; y < bottom; ++y) {
    for (std::size_t x = left; x < right; ++x) {
      const std::size_t pixel = y * m_width + x;
      mix(pixel, colour, static_cast<double>(m_depths[pixel]) < centre.depth ? kHiddenOpacity : 1.0);
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

bool Raster::isSeen(const RasterPoint& point) const {
  const bool isIn = point.x >= 0.0 && point.y >= 0.0 && point.x < static_cast<double>(m_width) &&
                    point.y < static_cast<double>(m_height);
  if (!isIn) return false;
  const std::size_t pixel = static_cast<std::size_t>(point.y) * m_width + static_cast<std::size_t>(point.x);
  return point.depth <= static_cast<double>(m_depths[pixel]);
}

Raster Raster::halved() const {
  Raster result(m_width / 2, m_height / 2, {});
  for (std::size_t y = 0; y < result.m_height; ++y) {
    for (std::size_t x = 0; x < result.m_width; ++x) {
      for (std::size_t i = 0; i < 3; ++i) {
        const int sum =
            at(2 * x, 2 * y)[i] + at(2 * x + 1, 2 * y)[i] + at(2 * x, 2 * y + 1)[i] + at(2 * x + 1, 2 * y + 1)[i];
        result.m_pixels[y * result.m_width + x][i] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return result;
}

}  // namespace allpairs::view
