// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/PairPredicate.h"
#include "allpairs/scene/ReadOptions.h"
#include "cli/Options.h"

namespace allpairs::app {

/// Boxes that move, frame by frame.
class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  FrameSource(FrameSource&&) = delete;
  FrameSource& operator=(FrameSource&&) = delete;
  virtual ~FrameSource() = default;

  [[nodiscard]] virtual std::size_t frameCount() const = 0;

  /// The boxes of the next frame, as many in each; valid until the next call.
  ///
  /// Bad input: throws FileError.
  [[nodiscard]] virtual BoxView next() = 0;

  /// How many boxes each frame has, where that is known before the first.
  [[nodiscard]] virtual std::size_t boxCount() const { return 0; }

  /// Which overlapping boxes are a pair; empty where all are. To be asked for after the first frame.
  [[nodiscard]] virtual PairPredicate accept() const { return {}; }
};

/// The frames of one .npy file, (t, n, 6); or of mesh files, one each: the boxes of their triangles, of which two with
/// a vertex in common are never paired.
///
/// Bad input: throws FileError; more than one .npy file, or one among meshes, throws UsageError.
[[nodiscard]] std::unique_ptr<FrameSource> openFrames(const InputSettings& input);

}  // namespace allpairs::app
