// SPDX-License-Identifier: MIT
#include "Raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace allpairs::view {
namespace {

/// A coordinate that is linear along a row of pixels, and not negative in the part of it that a triangle covers.
struct Slope {
  explicit Slope(double change) : perPixel(change), inverse(change != 0.0 ? 1.0 / change : 0.0) {}

  /// Keeps of a part of a row that in which the coordinate, given at x = 0, is not negative.
  void keepWhereNotNegative(double atZero, double& low, double& high) const {
    if (perPixel > 0.0) {
      low = std::max(low, -atZero * inverse);
    } else if (perPixel < 0.0) {
      high = std::min(high, -atZero * inverse);
    } else if (!(atZero >= 0.0)) {
      high = -std::numeric_limits<double>::infinity();
    }
  }

  double perPixel;
  double inverse;
};

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
  const double left = std::min({a.x, b.x, c.x});
  const double right = std::max({a.x, b.x, c.x});
  const auto [top, bottom] = cut(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), m_height);
  const Slope uSlope((b.y - c.y) / area);  // of the barycentric coordinates
  const Slope vSlope((c.y - a.y) / area);
  const Slope wSlope(-uSlope.perPixel - vSlope.perPixel);
  for (std::size_t y = top; y < bottom; ++y) {
    const double u0 = crossAt(b, c, 0.0, static_cast<double>(y)) / area;
    const double v0 = crossAt(c, a, 0.0, static_cast<double>(y)) / area;
    double low = left;
    double high = right;
    uSlope.keepWhereNotNegative(u0, low, high);
    vSlope.keepWhereNotNegative(v0, low, high);
    wSlope.keepWhereNotNegative(1.0 - u0 - v0, low, high);
    const auto [begin, end] = cut(low, high, m_width);
    for (std::size_t x = begin; x < end; ++x) {
      const double u = u0 + uSlope.perPixel * static_cast<double>(x);
      const double v = v0 + vSlope.perPixel * static_cast<double>(x);
      paint(y * m_width + x, u * a.depth + v * b.depth + (1.0 - u - v) * c.depth);
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

Raster Raster::halved() const {
  Raster result(m_width / 2, m_height / 2, {});
  for (std::size_t y = 0; y < result.m_height; ++y) {
    const Colour* above = &m_pixels[2 * y * m_width];
    const Colour* below = above + m_width;
    Colour* pixel = &result.m_pixels[y * result.m_width];
    for (std::size_t x = 0; x < 2 * result.m_width; x += 2, ++pixel) {
      for (std::size_t i = 0; i < 3; ++i) {
        const int sum = above[x][i] + above[x + 1][i] + below[x][i] + below[x + 1][i];
        (*pixel)[i] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return result;
}

}  // namespace allpairs::view
