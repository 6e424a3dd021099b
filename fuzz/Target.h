// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <span>
#include <string_view>

#ifdef ALLPAIRS_FUZZ_REPLAY
#include "Replay.h"
#endif

namespace allpairs::fuzz {

/// The input of one execution.
using Bytes = std::span<const std::uint8_t>;

/// Ends the program unless the property holds: how a target reports a finding that no sanitizer sees.
inline void require(bool holds, std::string_view property) {
  if (holds) return;
  std::cerr << "does not hold: " << property << '\n';
  std::abort();
}

}  // namespace allpairs::fuzz

// Defines a fuzz target from a function that takes Bytes: libFuzzer's entry point, or a test that replays kept inputs.
#ifdef ALLPAIRS_FUZZ_REPLAY
#define ALLPAIRS_FUZZ_TARGET(name, function) \
  TEST(name, HoldsForItsCorpusAndRegressions) { allpairs::fuzz::replay(#name, function); }
#else
#define ALLPAIRS_FUZZ_TARGET(name, function)                                                                \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size); /* NOLINT: its name */ \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {                       \
    function(allpairs::fuzz::Bytes(data, size));                                                            \
    return 0;                                                                                               \
  }
#endif
