// SPDX-License-Identifier: MIT
#include "allpairs/scene/BoxFrames.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"
#include "boxes/NpyInput.h"
#include "input/FileBytes.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

/// Frames without boxes take no byte of a file, and memory all the same.
constexpr std::uint64_t kMostEmptyFrames = 1'000'000;

void checkFrames(const NpyHeader& header, const Path& path, const std::string& part) {
  if (header.shape.size() != 3 || header.shape[2] != 6) {
    throw FileError(path, "has shape " + shapeText(header.shape) + "; " + part + "s of boxes are (" +
                              (part == "frame" ? "t" : part.substr(0, 1)) + ", n, 6)");
  }
  if (header.fortranOrder) throw FileError(path, "is in Fortran order, in which frames are not one after the other");
  if (header.shape[1] == 0 && header.shape[0] > kMostEmptyFrames) {
    throw FileError(path, "claims " + std::to_string(header.shape[0]) + " " + part + "s without boxes; at most " +
                              std::to_string(kMostEmptyFrames) + " are taken");
  }
  if (header.shape[1] > std::numeric_limits<std::uint32_t>::max()) {
    throw FileError(path, "claims " + std::to_string(header.shape[1]) + " boxes; at most 4294967295 can be numbered");
  }
}

}  // namespace

bool isBoxFramesFile(const Path& path) {
  if (lowerExtension(path) != ".npy") return false;
  InputFile file(path);
  return readNpyHeader(file, path).shape.size() == 3;
}

struct BoxFrames::State {
  State(const Path& filePath, std::string partName)
      : path(filePath), part(std::move(partName)), file(filePath), header(readNpyHeader(file, filePath)) {}

  [[nodiscard]] std::uint64_t itemSize() const { return isFloat32 ? sizeof(float) : sizeof(double); }

  template <class T>
  BoxView read(std::vector<T>& rows) {
    rows.resize(static_cast<std::size_t>(header.shape[1]) * 6);
    file.read(rows.data(), rows.size() * sizeof(T));
    toNativeOrder(header, rows.data(), rows.size());
    return BoxView::fromRows(std::span<const T>(rows));
  }

  Path path;
  std::string part;
  InputFile file;
  NpyHeader header;
  bool isFloat32 = false;
  std::size_t frame = 0;
  std::vector<float> float32;
  std::vector<double> float64;
};

BoxFrames::BoxFrames(const Path& path, const std::string& part) : m_state(std::make_unique<State>(path, part)) {
  m_state->isFloat32 = holdsFloat32(m_state->header, path);
  checkFrames(m_state->header, path, part);
  requireLength(m_state->header, m_state->itemSize(), m_state->file, path);
}

BoxFrames::~BoxFrames() = default;
BoxFrames::BoxFrames(BoxFrames&&) noexcept = default;
BoxFrames& BoxFrames::operator=(BoxFrames&&) noexcept = default;

std::size_t BoxFrames::frameCount() const noexcept { return static_cast<std::size_t>(m_state->header.shape[0]); }
std::size_t BoxFrames::boxCount() const noexcept { return static_cast<std::size_t>(m_state->header.shape[1]); }
std::uint64_t BoxFrames::frameBytes() const noexcept { return m_state->header.shape[1] * 6 * m_state->itemSize(); }

BoxView BoxFrames::next() {
  State& state = *m_state;
  if (state.frame == frameCount()) throw InvalidArgument("there are only " + std::to_string(state.frame) + " frames");
  const std::size_t frame = state.frame++;
  try {
    return state.isFloat32 ? state.read(state.float32) : state.read(state.float64);
  } catch (const InvalidBox& problem) {
    throw FileError(state.path, state.part + " " + std::to_string(frame) + ": " + problem.what());
  }
}

}  // namespace allpairs::scene
