// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "Target.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "allpairs/scene/ReadInput.h"
#include "support/TempFolder.h"

namespace allpairs::fuzz {

/// The folder in which inputs become files; each replaces the last one.
inline const test::TempFolder& folder() {
  static const test::TempFolder folder;
  return folder;
}

inline std::filesystem::path writeFile(const std::string& name, Bytes bytes) {
  return folder().write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// What an error must be, whatever the input says: one line that can be printed.
inline void examine(const Error& error) {
  constexpr std::size_t kMostCharacters = 500;  // Beside the folder, which is not the input's choice.
  const std::string_view text = error.what();
  require(!text.empty(), "an error has a message");
  require(text.size() <= kMostCharacters + folder().path().string().size(), "a message is at most 500 characters long");
  for (const char c : text)
    require(c != '\x7f' && static_cast<unsigned char>(c) >= 0x20, "a message is one line of text");
}

/// Finds the pairs of the models that were read, as the command does, and compares them with the double loop over all.
inline void detect(scene::Scene& scene) {
  constexpr std::size_t kMostModels = 300;  // The double loop is quadratic.
  for (const scene::SceneSearch& search : scene::searchesOf(scene)) {
    collision::BruteForceBroadPhase broadPhase;
    if (search.region) broadPhase.setBox(*search.region);
    collision::CollisionPipeline pipeline;
    pipeline.setIntersectionMethod(search.intersection);
    pipeline.setBroadPhase(&broadPhase);
    pipeline.step(search.models, scene.timeStep);
    if (search.models.size() <= kMostModels) broadPhase.verify();
  }
}

/// Reads a file with the reader that its name asks for. An error of ours is an answer; anything else is a finding.
inline void readAndDetect(const std::filesystem::path& path) {
  scene::Scene scene;
  try {
    scene = scene::readInput(path);
    require(scene.intersection != nullptr, "a scene has an intersection method");
    detect(scene);
  } catch (const collision::VerificationError&) {
    require(false, "the search gives the pairs of the double loop over models");
  } catch (const Error& error) {
    examine(error);
  }
}

}  // namespace allpairs::fuzz
