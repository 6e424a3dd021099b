// SPDX-License-Identifier: MIT
#include "../LoadedMesh.h"

namespace allpairs::fuzz {
namespace {

void runVtu(Bytes bytes) { readAndDetect(loadedMesh("MeshVTKLoader", "input.vtu", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(vtu, allpairs::fuzz::runVtu)
