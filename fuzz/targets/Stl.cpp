// SPDX-License-Identifier: MIT
#include "../SceneFile.h"

namespace allpairs::fuzz {
namespace {

void runStl(Bytes bytes) { readAndDetect(writeFile("input.stl", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(stl, allpairs::fuzz::runStl)
