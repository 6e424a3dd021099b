// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>

namespace allpairs::test {

/// The folder of real data with known answers: $ALLPAIRS_DATA, or shared/data beside the project; empty if neither is
/// there. The project carries none of it, so tests that read it skip where it is absent.
inline std::filesystem::path dataFolder() {
  const char* named = std::getenv("ALLPAIRS_DATA");  // NOLINT(concurrency-mt-unsafe): nothing sets it
  const std::filesystem::path folder = named != nullptr ? named : "../shared/data";
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

}  // namespace allpairs::test
