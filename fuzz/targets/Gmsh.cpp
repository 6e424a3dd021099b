// SPDX-License-Identifier: MIT
#include "../LoadedMesh.h"

namespace allpairs::fuzz {
namespace {

void runGmsh(Bytes bytes) { readAndDetect(loadedMesh("MeshGmshLoader", "input.msh", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(gmsh, allpairs::fuzz::runGmsh)
