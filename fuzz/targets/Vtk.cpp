// SPDX-License-Identifier: MIT
#include "../LoadedMesh.h"

namespace allpairs::fuzz {
namespace {

void runVtk(Bytes bytes) { readAndDetect(loadedMesh("MeshVTKLoader", "input.vtk", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(vtk, allpairs::fuzz::runVtk)
