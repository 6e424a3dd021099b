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
#include "input/ByteOrder.h"
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

/// Throws FileError unless what is left of the file are as many numbers as the header says, no more and no less. Asked
/// before anything is allocated for them.
void requireLength(const NpyHeader& header, std::uint64_t itemSize, const InputFile& file,
                   const std::filesystem::path& path);

/// Turns numbers as they stand in the file into those of this machine.
template <class T>
void toNativeOrder(const NpyHeader& header, T* numbers, std::size_t count) {
  const std::endian order = header.descr.front() == '>' ? std::endian::big : std::endian::little;
  if (order == std::endian::native) return;
  std::for_each_n(numbers, count, [order](T& number) {
    number = numberOf<T>({reinterpret_cast<const char*>(&number), sizeof(T)}, order);
  });
}

}  // namespace allpairs::scene
