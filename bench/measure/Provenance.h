// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace allpairs::measure {

/// On what a measurement was made: without it a time says nothing.
struct Provenance {
  std::string commit;  ///< Of the source that was built; ends in "-dirty" if it had changes.
  std::string compiler;
  std::string buildType;
  std::string processor;  ///< As the operating system calls it.
  std::size_t processors = 0;
  std::string date;  ///< Of the measurement, UTC, as 2026-11-21T05:10Z.
};

[[nodiscard]] Provenance provenance();

}  // namespace allpairs::measure
