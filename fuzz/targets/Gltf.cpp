// SPDX-License-Identifier: MIT
// Both forms of glTF: what starts as a binary one is read as that.
#include <algorithm>

#include "../SceneFile.h"

// Assimp 5.2 forgets memory when it finds an error. Called by LeakSanitizer.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): the name it looks for
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }

namespace allpairs::fuzz {
namespace {

void runGltf(Bytes bytes) {
  constexpr std::string_view kMagic = "glTF";
  const bool isBinary = bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
  readAndDetect(writeFile(isBinary ? "input.glb" : "input.gltf", bytes));
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(gltf, allpairs::fuzz::runGltf)
