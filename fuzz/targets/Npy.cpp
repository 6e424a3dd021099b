// SPDX-License-Identifier: MIT
// A .npy file as one array of boxes, and as boxes that move.
#include "../BoxFile.h"
#include "allpairs/scene/BoxFrames.h"

namespace allpairs::fuzz {
namespace {

void readFrames(const std::filesystem::path& path) {
  constexpr std::size_t kMostFrames = 100;
  try {
    scene::BoxFrames frames(path);
    for (std::size_t i = 0; i < frames.frameCount() && i < kMostFrames; ++i) {
      require(frames.next().size() == frames.boxCount(), "each frame has as many boxes");
    }
  } catch (const Error& error) {
    examine(error);
  }
}

void runNpy(Bytes bytes) {
  const std::filesystem::path path = writeFile("input.npy", bytes);
  readBoxes(path);
  readFrames(path);
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(npy, allpairs::fuzz::runNpy)
