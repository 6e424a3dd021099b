// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "FileBytes.h"
#include "NpyHeader.h"
#include "allpairs/Error.h"
#include "allpairs/scene/BoxArray.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

constexpr std::uint32_t kMaxHeader = 1 << 20;  // a thousand times what a header of three keys needs

/// Where the length of the header stands, by format version: 16 bits in the first, 32 since.
std::uint32_t readHeaderLength(InputFile& file, const Path& path) {
  std::array<unsigned char, 8> start{};
  if (file.remaining() < start.size()) throw FileError(path, "is too short for a .npy file");
  file.read(start.data(), start.size());
  if (std::memcmp(start.data(), "\x93NUMPY", 6) != 0) throw FileError(path, "is not a .npy file: its magic is missing");
  const int version = start[6];
  if (version < 1 || version > 3) {
    throw FileError(path, "is of .npy version " + std::to_string(version) + "; versions 1 to 3 are known");
  }
  std::array<unsigned char, 4> length{};
  file.read(length.data(), version == 1 ? 2 : 4);
  return static_cast<std::uint32_t>(length[0]) | static_cast<std::uint32_t>(length[1]) << 8 |
         static_cast<std::uint32_t>(length[2]) << 16 | static_cast<std::uint32_t>(length[3]) << 24;
}

NpyHeader readHeader(InputFile& file, const Path& path) {
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

std::string shapeText(const std::vector<std::uint64_t>& shape) {
  std::string text = "(";
  for (const std::uint64_t extent : shape) text += std::to_string(extent) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  if (shape.size() == 1) text.pop_back();
  return text + ")";
}

void checkShape(const NpyHeader& header, const Path& path) {
  if (header.shape.size() != 2 || header.shape[1] != 6) {
    throw FileError(path, "has shape " + shapeText(header.shape) + "; boxes are (n, 6)");
  }
  if (header.shape[0] > std::numeric_limits<std::uint32_t>::max()) {
    throw FileError(path, "claims " + std::to_string(header.shape[0]) + " boxes; at most 4294967295 can be numbered");
  }
}

/// The file holds what its header says, no more and no less. Asked before anything is allocated for it.
void checkLength(std::uint64_t size, std::uint64_t itemSize, const InputFile& file, const Path& path) {
  const std::uint64_t expected = size * 6 * itemSize;
  if (file.remaining() == expected) return;
  throw FileError(path, "holds " + std::to_string(file.remaining()) + " bytes of numbers where its shape (" +
                            std::to_string(size) + ", 6) needs " + std::to_string(expected));
}

template <class T>
void reverseBytes(T& value) {
  auto bytes = std::bit_cast<std::array<unsigned char, sizeof(T)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  value = std::bit_cast<T>(bytes);
}

template <class T>
BoxArray readTable(const NpyHeader& header, InputFile& file, const Path& path) {
  const auto size = static_cast<std::size_t>(header.shape[0]);
  checkLength(size, sizeof(T), file, path);
  BoxTable<T> table{std::make_unique_for_overwrite<T[]>(size * 6), size, header.fortranOrder};
  file.read(table.values.get(), size * 6 * sizeof(T));
  const bool littleEndian = header.descr.front() != '>';
  if (littleEndian != (std::endian::native == std::endian::little)) {
    std::for_each_n(table.values.get(), size * 6, reverseBytes<T>);
  }
  try {
    return {std::move(table), path.filename().string()};
  } catch (const InvalidBox& problem) {
    throw FileError(path, problem.what());
  }
}

}  // namespace

BoxArray readNpy(const Path& path) {
  InputFile file(path);
  const NpyHeader header = readHeader(file, path);
  const bool isFloat32 = header.descr == "<f4" || header.descr == ">f4";
  const bool isFloat64 = header.descr == "<f8" || header.descr == ">f8";
  if (!isFloat32 && !isFloat64) {
    throw FileError(path, "holds numbers of type '" + header.descr + "'; boxes are float32 ('<f4') or float64 ('<f8')");
  }
  checkShape(header, path);
  return isFloat32 ? readTable<float>(header, file, path) : readTable<double>(header, file, path);
}

}  // namespace allpairs::scene
