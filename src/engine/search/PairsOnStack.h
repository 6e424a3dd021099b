// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Room for pairs on the stack. Pairs themselves would be set to 0 first, which takes longer than many a search.
template <std::size_t kSize>
class PairsOnStack {
 public:
  [[nodiscard]] Pair* data() noexcept { return reinterpret_cast<Pair*>(m_bytes.data()); }

 private:
  alignas(64) std::array<std::byte, kSize * sizeof(Pair)> m_bytes;
};

}  // namespace allpairs::engine
