// SPDX-License-Identifier: MIT
#include "Provenance.h"

#include <array>
#include <ctime>
#include <fstream>
#include <thread>

#include "Commit.h"  // Written by the build.

namespace allpairs::measure {

namespace {

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

std::string processor() {
  std::ifstream information("/proc/cpuinfo");
  for (std::string line; std::getline(information, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%MZ", &utc)};
}

}  // namespace

Provenance provenance() {
  return {.commit = ALLPAIRS_COMMIT,
          .compiler = compiler(),
          .buildType = ALLPAIRS_BUILD_TYPE,
          .processor = processor(),
          .processors = std::thread::hardware_concurrency(),
          .date = date()};
}

}  // namespace allpairs::measure
