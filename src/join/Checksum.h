// SPDX-License-Identifier: MIT
#pragma once

// All of it is inlined: what is installed needs no library.
#define XXH_INLINE_ALL  // NOLINT(readability-identifier-naming): the library's name
#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace allpairs::join {

/// The XXH3 checksum of bytes that come in parts.
class Checksum {
 public:
  Checksum() : m_state(std::make_unique<XXH3_state_t>()) { XXH3_64bits_reset(m_state.get()); }

  void add(const void* bytes, std::size_t count) { XXH3_64bits_update(m_state.get(), bytes, count); }

  [[nodiscard]] std::uint64_t value() const { return XXH3_64bits_digest(m_state.get()); }

 private:
  std::unique_ptr<XXH3_state_t> m_state;
};

/// That of a text.
[[nodiscard]] inline std::uint64_t checksumOf(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

}  // namespace allpairs::join
