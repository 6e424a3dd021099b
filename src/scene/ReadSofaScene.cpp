// SPDX-License-Identifier: MIT
#include "allpairs/scene/ReadSofaScene.h"

#include "allpairs/Error.h"

namespace allpairs::scene {

Scene readSofaScene(const std::filesystem::path& path, const ReadOptions&) {
  throw FileError(path, "SOFA scenes are not read yet");
}

}  // namespace allpairs::scene
