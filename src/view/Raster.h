// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace allpairs::view {

using Colour = std::array<std::uint8_t, 3>;

/// The integer nearest to a shade of 0 to 255; lround() is a call, and several times slower here.
[[nodiscard]] inline std::uint8_t shade(double value) {
  return static_cast<std::uint8_t>(value + 0.5);  // NOLINT(bugprone-incorrect-roundings): none is negative
}

/// A place in a picture: pixels to the right and down, and how far behind the picture's plane it is.
struct RasterPoint {
  double x = 0.0;
  double y = 0.0;
  double depth = 0.0;
};

/// A picture with a depth for each pixel, into which triangles and lines are drawn.
///
/// Whatever lies outside of the picture is cut off.
class Raster {
 public:
  Raster(std::size_t width, std::size_t height, Colour background);

  [[nodiscard]] std::size_t width() const { return m_width; }
  [[nodiscard]] std::size_t height() const { return m_height; }
  [[nodiscard]] Colour at(std::size_t x, std::size_t y) const { return m_pixels[y * m_width + x]; }

  /// Row by row.
  [[nodiscard]] std::span<const Colour> pixels() const { return m_pixels; }

  /// Hides what is behind it.
  void triangle(const std::array<RasterPoint, 3>& corners, Colour colour);

  /// Mixes its colour with what is there, opacity from 0 to 1, wherever it is; hides nothing.
  void veil(const std::array<RasterPoint, 3>& corners, Colour colour, double opacity);

  /// A line of a width in pixels. Where something else is in front of it, it is faint.
  void line(const RasterPoint& begin, const RasterPoint& end, Colour colour, double width);

  /// Puts another picture over a part of this one, in front of everything; `left` and `top` are of its first pixel.
  void paste(const Raster& other, std::size_t left, std::size_t top);

  /// Whether nothing that was drawn is in front of a point, which is in the picture.
  [[nodiscard]] bool isSeen(const RasterPoint& point) const;

  /// Puts it into a picture of half the width and height, each pixel the mean of four.
  void halveInto(Raster& result) const;

  /// As it was in the beginning.
  void clear(Colour background);

 private:
  template <class Paint>
  void scan(const std::array<RasterPoint, 3>& corners, const Paint& paint) const;
  void mix(std::size_t pixel, Colour colour, double opacity);
  void stamp(const RasterPoint& centre, Colour colour, double radius);

  std::size_t m_width;
  std::size_t m_height;
  std::vector<Colour> m_pixels;
  std::vector<float> m_depths;
};

}  // namespace allpairs::view
