// SPDX-License-Identifier: MIT
#include "../SceneFile.h"

namespace allpairs::fuzz {
namespace {

void runOff(Bytes bytes) { readAndDetect(writeFile("input.off", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(off, allpairs::fuzz::runOff)
