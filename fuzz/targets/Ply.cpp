// SPDX-License-Identifier: MIT
#include "../SceneFile.h"

namespace allpairs::fuzz {
namespace {

void runPly(Bytes bytes) { readAndDetect(writeFile("input.ply", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(ply, allpairs::fuzz::runPly)
