// SPDX-License-Identifier: MIT
// A scene beside files that it may name: part.obj, part.msh, part.vtk, part.sph, part.off.
#include "../SceneFile.h"

namespace allpairs::fuzz {
namespace {

void writeParts() {
  folder().write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nl 3 4\n");
  folder().write("part.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n");
  folder().write("part.sph", "sph 1.0\nnumSphe 2\nsphe 0 0 0 0 1\nsphe 1 2 0 0 0.5\n");
  folder().write("part.msh",
                 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
                 "$Elements\n2\n1 4 0 1 2 3 4\n2 2 0 1 2 3\n$EndElements\n");
  folder().write("part.vtk",
                 "# vtk DataFile Version 2.0\npart\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
                 "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
}

void runScn(Bytes bytes) {
  static const bool areWritten = (writeParts(), true);
  static_cast<void>(areWritten);
  readAndDetect(writeFile("input.scn", bytes));
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(scn, allpairs::fuzz::runScn)
