// SPDX-License-Identifier: MIT
#include "boxes/NpyInput.h"

#include <cstring>
#include <limits>

#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

constexpr std::uint32_t kMaxHeader = 1 << 20;  // a thousand times what a header of three keys needs

/// Where the length of the header stands, by format version: 16 bits in the first, 32 since.
std::uint32_t readHeaderLength(InputFile& file, const Path& path) {
  std::array<unsigned char, 8> start{};
  if (file.remaining() < start.size()) throw FileError(path, "is too short for a .npy file");
  file.read(start.data(), start.size());
  if (std::memcmp(start.data(), kNpyMagic.data(), kNpyMagic.size()) != 0)
    throw FileError(path, "is not a .npy file, as numpy.save() writes it");
  const int version = start[6];
  if (version < 1 || version > 3) {
    throw FileError(path, "is of .npy version " + std::to_string(version) + "; versions 1 to 3 are known");
  }
  std::array<char, 4> length{};
  file.read(length.data(), version == 1 ? 2 : 4);
  return littleEndian<std::uint32_t>({length.data(), length.size()});
}

}  // namespace

NpyHeader readNpyHeader(InputFile& file, const Path& path) {
  const std::uint32_t length = readHeaderLength(file, path);
  if (length > file.remaining()) throw FileError(path, "ends within its header");
  if (length > kMaxHeader) throw FileError(path, "has a header of " + std::to_string(length) + " bytes");
  std::string text(length, '\0');
  file.read(text.data(), text.size());
  try {
    return parseNpyHeader(text);
  } catch (const InvalidArgument& problem) {
    throw FileError(path, problem.what());
  }
}

void requireLength(const NpyHeader& header, std::uint64_t itemSize, const InputFile& file, const Path& path) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t size = itemSize;
  for (const std::uint64_t extent : header.shape) size = extent != 0 && size > kMost / extent ? kMost : size * extent;
  if (size == file.remaining()) return;
  throw FileError(path, "holds " + std::to_string(file.remaining()) + " bytes of numbers where its shape " +
                            shapeText(header.shape) + " needs " + (size == kMost ? "more" : std::to_string(size)));
}

bool holdsFloat32(const NpyHeader& header, const Path& path) {
  if (header.descr == "<f4" || header.descr == ">f4") return true;
  if (header.descr == "<f8" || header.descr == ">f8") return false;
  throw FileError(path, "holds numbers of type '" + header.descr + "'; boxes are float32 ('<f4') or float64 ('<f8')");
}

}  // namespace allpairs::scene
