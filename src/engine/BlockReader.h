// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "Kernels.h"
#include "LaneReader.h"

namespace allpairs::engine {

/// Reads boxes sixteen at a time, by a kernel, where they lie so that one can.
class BlockReader {
 public:
  BlockReader(const LaneReader& reader, const Kernels& kernels) : m_kernels(&kernels) {
    if (reader.size() > kMostBoxes) return;
    m_float32 = reader.plainFloat32();
    m_float64 = reader.plainFloat64();
  }

  /// Whether the boxes can be read this way; if not, nothing else here may be called.
  [[nodiscard]] bool isUsable() const noexcept { return m_float32 != nullptr || m_float64 != nullptr; }

  /// Asks for the memory of a box ahead of its use.
  void prefetch(std::size_t index) const noexcept {
    if (m_float32 != nullptr) {
      __builtin_prefetch(m_float32 + 6 * index);
      __builtin_prefetch(m_float32 + 6 * index + 5);
    } else {
      __builtin_prefetch(m_float64 + 6 * index);
      __builtin_prefetch(m_float64 + 6 * index + 5);
    }
  }

  /// Boxes begin to begin + 15.
  [[nodiscard]] RowBlockResult readRun(std::size_t begin, LaneBlock& block) const {
    static constexpr std::array<std::int32_t, kFanOut> kOffsets{0,  6,  12, 18, 24, 30, 36, 42,
                                                                48, 54, 60, 66, 72, 78, 84, 90};
    return m_float32 != nullptr ? m_kernels->readRun32(m_float32 + 6 * begin, block)
                                : m_kernels->readFloat64(m_float64 + 6 * begin, kOffsets.data(), block);
  }

  /// The boxes whose first values are at these offsets, six times their index.
  [[nodiscard]] RowBlockResult readAt(const std::array<std::int32_t, kFanOut>& offsets, LaneBlock& block) const {
    return m_float32 != nullptr ? m_kernels->readFloat32(m_float32, offsets.data(), block)
                                : m_kernels->readFloat64(m_float64, offsets.data(), block);
  }

 private:
  /// Offsets are numbers of 32 bits.
  static constexpr std::size_t kMostBoxes = std::numeric_limits<std::int32_t>::max() / 6;

  const Kernels* m_kernels;
  const float* m_float32 = nullptr;
  const double* m_float64 = nullptr;
};

}  // namespace allpairs::engine
