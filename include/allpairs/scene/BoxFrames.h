// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "allpairs/BoxView.h"

namespace allpairs::scene {

/// Whether the path is a NumPy file of three dimensions.
///
/// Bad input: a .npy file that is missing, unreadable or malformed throws FileError.
[[nodiscard]] bool isBoxFramesFile(const std::filesystem::path& path);

/// Reads moving boxes from a file, frame by frame; one frame is in memory at a time.
///
/// The file is a NumPy array of shape (t, n, 6), float32 or float64, either byte order, C order: t frames of n boxes.
/// Bad input: anything else throws FileError, and so does a NaN, naming frame and box.
/// Cost:      one read of each frame; the memory of one.
class BoxFrames {
 public:
  /// `part` is what messages call a frame.
  explicit BoxFrames(const std::filesystem::path& path, const std::string& part = "frame");
  ~BoxFrames();
  BoxFrames(BoxFrames&&) noexcept;
  BoxFrames& operator=(BoxFrames&&) noexcept;

  [[nodiscard]] std::size_t frameCount() const noexcept;
  [[nodiscard]] std::size_t boxCount() const noexcept;

  /// The memory of a frame, in bytes.
  [[nodiscard]] std::uint64_t frameBytes() const noexcept;

  /// The boxes of the next frame; valid until the next call.
  ///
  /// Bad input: more than frameCount() calls throw InvalidArgument.
  [[nodiscard]] BoxView next();

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::scene
