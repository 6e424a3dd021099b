// SPDX-License-Identifier: MIT
#pragma once

// All of it is inlined: what is installed needs no library.
#define XXH_INLINE_ALL  // NOLINT(readability-identifier-naming): the library's name
#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace allpairs::join {

/// The XXH64 checksum of bytes that come in parts. Of each of many cells there is one: it is small.
class Checksum {
 public:
  Checksum() { XXH64_reset(&m_state, 0); }

  void add(const void* bytes, std::size_t count) { XXH64_update(&m_state, bytes, count); }

  [[nodiscard]] std::uint64_t value() const { return XXH64_digest(&m_state); }

 private:
  XXH64_state_t m_state{};
};

/// That of a text.
[[nodiscard]] inline std::uint64_t checksumOf(std::string_view text) { return XXH64(text.data(), text.size(), 0); }

}  // namespace allpairs::join
