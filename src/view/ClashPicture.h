// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "Clash.h"
#include "Raster.h"
#include "allpairs/Executor.h"

namespace allpairs::view {

/// A camera without perspective.
struct ParallelCamera {
  std::array<double, 3> centre{};     ///< What is in the middle of the picture.
  std::array<double, 3> direction{};  ///< Where it looks, of length 1.
  std::array<double, 3> up{};         ///< At right angles to it.
  double height = 1.0;                ///< How much of the world the picture's height shows.
};

/// Where points are in a picture of some pixels.
class Projection {
 public:
  Projection(const ParallelCamera& camera, const Raster& raster);

  [[nodiscard]] RasterPoint operator()(const std::array<double, 3>& p) const;

  /// What lies to the right in the picture.
  [[nodiscard]] const std::array<double, 3>& right() const { return m_right; }

 private:
  ParallelCamera m_camera;
  std::array<double, 3> m_right;
  std::array<double, 2> m_middle;
  double m_scale;
};

/// A camera that shows both boxes of a clash, or, where one is much larger, the smaller one and what is around it.
[[nodiscard]] ParallelCamera cameraOf(const ViewScene& scene, const Clash& clash);

/// Chooses for at most so many pairs, the worst first, the side from which cameraOf() looks at them, once for the page,
/// the pictures and the BCF: each takes milliseconds.
void chooseSides(ViewScene& scene, std::size_t most, Executor& executor);

/// Whether chooseSides() has chosen one for a pair.
[[nodiscard]] bool hasSide(const ViewScene& scene, std::size_t pair);

/// A camera that shows all models, from the side from which most clashes are seen.
[[nodiscard]] ParallelCamera cameraOfAll(const ViewScene& scene);

/// All models from afar, drawn once, to show in the pictures of clashes where in the whole they are.
class Overview {
 public:
  explicit Overview(const ViewScene& scene);

  /// Puts it small into a corner of a picture, with a mark at the middle of a place. Of a scene with no more than the
  /// two models of a clash, and of a picture without room for it, nothing is added.
  void addTo(Raster& picture, const Box& place) const;

 private:
  std::size_t m_modelCount;
  ParallelCamera m_camera;
  Raster m_raster;
};

/// Draws pictures of clashes, one after the other, in the same memory.
class ClashPainter {
 public:
  explicit ClashPainter(const ViewScene& scene);

  /// The two models of a clash in two colours, with their contact, or with their boxes and in red what the boxes share;
  /// until the next picture is drawn.
  [[nodiscard]] Raster& paint(const Clash& clash, const ParallelCamera& camera);

 private:
  const ViewScene* m_scene;
  Raster m_canvas;
  Raster m_picture;
};

}  // namespace allpairs::view
