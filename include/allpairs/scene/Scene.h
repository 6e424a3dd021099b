// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/collision/CollisionModel.h"
#include "allpairs/collision/Intersection.h"

namespace allpairs::scene {

/// A part of the input that was left out, and why.
struct Remark {
  std::filesystem::path file{};
  std::size_t line = 0;  ///< From 1; 0 where the file has no lines.
  std::string
      subject{};  ///< What was left out, by the name that the user knows: a path in the scene, an object's name.
  std::string reason{};
  bool isPartial = false;  ///< It is missing among the models: what would be an error without ReadOptions::partial.
};

/// One thing that models belong to: a node of a scene, an object of a mesh file. Models of one owner are one body.
struct Owner {
  std::string path;
};

/// What a reader makes of its input: collision models in the order of traversal, and how they are to be tested.
struct Scene {
  std::vector<std::unique_ptr<collision::CollisionModel>> models;
  std::vector<std::unique_ptr<Owner>> owners;
  std::unique_ptr<collision::Intersection> intersection;  ///< Never null.
  std::string intersectionName;                           ///< As the file calls it; empty where it names none.
  std::optional<Box> region;
  double timeStep = 0.0;  ///< How far a continuous method looks ahead.
  std::vector<Remark> remarks;
};

/// A scene of nothing, with the method that stands where a file names none: discrete, alarm distance 0.
[[nodiscard]] Scene emptyScene();

/// Puts the models of `more` behind those of `scene`.
///
/// A model whose name is taken in `scene` gets a number behind it: "wheel#2". The first method and the first region
/// that a file names count for all; others get a remark.
void append(Scene& scene, Scene more);

}  // namespace allpairs::scene
