// SPDX-License-Identifier: MIT
#include "../SceneFile.h"

namespace allpairs::fuzz {
namespace {

void runObj(Bytes bytes) { readAndDetect(writeFile("input.obj", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(obj, allpairs::fuzz::runObj)
