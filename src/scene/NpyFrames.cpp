// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "FileBytes.h"
#include "NpyInput.h"
#include "allpairs/Error.h"
#include "allpairs/scene/BoxFrames.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

void checkShape(const NpyHeader& header, const Path& path) {
  const auto& shape = header.shape;
  if (shape.size() != 3 || shape[2] != 6) {
    throw FileError(path, "has shape " + shapeText(shape) + "; boxes over time are (t, n, 6)");
  }
  if (shape[0] == 0) throw FileError(path, "has no frame: its shape is " + shapeText(shape));
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (shape[0] > kMost || shape[1] > kMost) throw FileError(path, "claims the shape " + shapeText(shape));
}

/// How many numbers there are, after a look at the file's length, so that nothing is allocated for what is only claimed.
std::size_t countOf(const NpyHeader& header, std::size_t itemSize, const InputFile& file, const Path& path) {
  const std::uint64_t held = file.remaining() / itemSize / 6;
  const std::uint64_t frames = header.shape[0];
  const std::uint64_t boxes = header.shape[1];
  const bool fits = boxes == 0 ? held == 0 : held / boxes == frames && held % boxes == 0;
  if (!fits || file.remaining() % (itemSize * 6) != 0) {
    throw FileError(path, "holds " + std::to_string(file.remaining()) +
                              " bytes of numbers, which is not what its shape " + shapeText(header.shape) + " needs");
  }
  return static_cast<std::size_t>(held * 6);
}

/// Where a number of a Fortran-ordered file belongs in rows.
std::size_t rowPlace(std::size_t i, const BoxFrames& frames) {
  const std::size_t frame = i % frames.frameCount;
  const std::size_t box = i / frames.frameCount % frames.boxCount;
  const std::size_t column = i / frames.frameCount / frames.boxCount;
  return (frame * frames.boxCount + box) * 6 + column;
}

template <class T>
BoxFrames readAs(const NpyHeader& header, InputFile& file, const Path& path) {
  std::vector<T> values(countOf(header, sizeof(T), file, path));
  readNpyNumbers(header, file, std::span<T>(values));
  BoxFrames result{static_cast<std::size_t>(header.shape[0]), static_cast<std::size_t>(header.shape[1]), {}};
  result.rows.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t place = header.fortranOrder ? rowPlace(i, result) : i;
    result.rows[place] = static_cast<double>(values[i]);
  }
  return result;
}

void checkNumbers(const BoxFrames& frames, const Path& path) {
  for (std::size_t i = 0; i < frames.rows.size(); ++i) {
    if (!std::isnan(frames.rows[i])) continue;
    const std::size_t box = i / 6;
    throw FileError(path, "box " + std::to_string(box % frames.boxCount) + " of frame " +
                              std::to_string(box / frames.boxCount) + " has a NaN");
  }
}

}  // namespace

bool isBoxFramesFile(const Path& path) {
  if (lowerExtension(path) != ".npy") return false;
  InputFile file(path);
  return readNpyHeader(file, path).shape.size() == 3;
}

BoxFrames readBoxFrames(const Path& path) {
  InputFile file(path);
  const NpyHeader header = readNpyHeader(file, path);
  checkShape(header, path);
  const bool isFloat32 = header.descr == "<f4" || header.descr == ">f4";
  if (!isFloat32 && header.descr != "<f8" && header.descr != ">f8") {
    throw FileError(path, "holds numbers of type '" + header.descr + "'; boxes are float32 ('<f4') or float64 ('<f8')");
  }
  BoxFrames frames = isFloat32 ? readAs<float>(header, file, path) : readAs<double>(header, file, path);
  checkNumbers(frames, path);
  return frames;
}

}  // namespace allpairs::scene
