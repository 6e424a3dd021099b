// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace allpairs::test {

/// The folder of real data with known answers: $ALLPAIRS_DATA, which has to be there if it is set, or shared/data beside
/// the project; empty if that is absent. The project carries none of it, so tests that read it skip then.
inline std::filesystem::path dataFolder() {
  const char* named = std::getenv("ALLPAIRS_DATA");  // NOLINT(concurrency-mt-unsafe): nothing sets it
  const std::filesystem::path folder = named != nullptr ? named : "../shared/data";
  if (std::filesystem::is_directory(folder)) return folder;
  if (named != nullptr) throw std::runtime_error("ALLPAIRS_DATA is no folder: " + folder.string());
  return {};
}

}  // namespace allpairs::test
