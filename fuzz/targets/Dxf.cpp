// SPDX-License-Identifier: MIT
#include "../SceneFile.h"

namespace allpairs::fuzz {
namespace {

void runDxf(Bytes bytes) { readAndDetect(writeFile("input.dxf", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(dxf, allpairs::fuzz::runDxf)
