// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "allpairs/StopFlag.h"
#include "allpairs/scene/BoxArray.h"
#include "boxes/NpyHeader.h"
#include "input/FileBytes.h"

namespace allpairs::scene {

/// readNpy(), which throws Stopped soon after a flag that is given is set.
[[nodiscard]] BoxArray readNpy(const std::filesystem::path& path, const StopFlag* stop);

/// Reads what stands before the numbers of a .npy file.
///
/// Bad input: throws FileError; nothing is allocated for what a header only claims.
[[nodiscard]] NpyHeader readNpyHeader(InputFile& file, const std::filesystem::path& path);

/// Whether the array holds float32; if not, it is float64.
///
/// Bad input: another type throws FileError.
[[nodiscard]] bool holdsFloat32(const NpyHeader& header, const std::filesystem::path& path);

/// Turns numbers as they stand in the file into those of this machine.
template <class T>
void toNativeOrder(const NpyHeader& header, T* numbers, std::size_t count) {
  const bool littleEndian = header.descr.front() != '>';
  if (littleEndian == (std::endian::native == std::endian::little)) return;
  std::for_each_n(numbers, count, [](T& value) {
    auto bytes = std::bit_cast<std::array<unsigned char, sizeof(T)>>(value);
    std::reverse(bytes.begin(), bytes.end());
    value = std::bit_cast<T>(bytes);
  });
}

}  // namespace allpairs::scene
