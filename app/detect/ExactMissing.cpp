// SPDX-License-Identifier: MIT
// What stands in for ExactSearch.cpp where FCL was not found.
#include "cli/ExitStatus.h"
#include "detect/Exact.h"

namespace allpairs::app {

void requireExact() {
  throw UsageError("--exact needs FCL, and this program was built without it (Debian's libfcl-dev, ALLPAIRS_FCL=ON)");
}

bool hasExact() { return false; }

ExactReport examine(const scene::Scene&, std::span<const Pair>, const ExactRequest&) {
  requireExact();
  return {};
}

}  // namespace allpairs::app
