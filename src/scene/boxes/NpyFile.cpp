// SPDX-License-Identifier: MIT
#include <limits>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/FileError.h"
#include "boxes/NpyHeader.h"
#include "boxes/NpyInput.h"
#include "input/FileBytes.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

void checkShape(const NpyHeader& header, const Path& path) {
  if (header.shape.size() != 2 || header.shape[1] != 6) {
    const bool isOfSeveral = header.shape.size() == 3 && header.shape[2] == 6;
    const std::string hint =
        isOfSeveral ? "; of several worlds or frames it is for 'allpairs detect --worlds', 'track' or 'view'" : "";
    throw FileError(path, "has shape " + shapeText(header.shape) + "; boxes are (n, 6)" + hint);
  }
  if (header.shape[0] > std::numeric_limits<std::uint32_t>::max()) {
    throw FileError(path, "claims " + std::to_string(header.shape[0]) + " boxes; at most 4294967295 can be numbered");
  }
}

template <class T>
BoxArray readTable(const NpyHeader& header, InputFile& file, const Path& path) {
  const auto size = static_cast<std::size_t>(header.shape[0]);
  requireLength(header, sizeof(T), file, path);  // before anything is allocated for it
  BoxTable<T> table{std::make_unique_for_overwrite<T[]>(size * 6), size, header.fortranOrder};
  file.read(table.values.get(), size * 6 * sizeof(T));
  toNativeOrder(header, table.values.get(), size * 6);
  try {
    return {std::move(table), path.filename().string()};
  } catch (const InvalidBox& problem) {
    throw FileError(path, problem.what());
  }
}

}  // namespace

BoxArray readNpy(const Path& path, const StopFlag* stop) {
  InputFile file(path, stop);
  const NpyHeader header = readNpyHeader(file, path);
  const bool isFloat32 = holdsFloat32(header, path);
  checkShape(header, path);
  return isFloat32 ? readTable<float>(header, file, path) : readTable<double>(header, file, path);
}

BoxArray readNpy(const Path& path) { return readNpy(path, nullptr); }

}  // namespace allpairs::scene
