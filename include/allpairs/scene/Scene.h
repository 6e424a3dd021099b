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

/// A part of the input that was skipped, and why.
struct Remark {
  std::filesystem::path file{};
  std::size_t line = 0;   ///< From 1; 0 where the file has no lines.
  std::string subject{};  ///< What was skipped, by the name that the user knows: a path in the scene, an object's name.
  std::string reason{};
  bool isPartial = false;  ///< A model is missing for it: without ReadOptions::partial it would be an error.
};

/// The owner of models: a node of a scene, an object of a mesh file. Models of one owner are one body.
struct Owner {
  std::string path;
};

/// The result of a reader: collision models in the order of traversal, and the intersection method.
struct Scene {
  std::vector<std::unique_ptr<collision::CollisionModel>> models;
  std::vector<std::unique_ptr<Owner>> owners;
  std::unique_ptr<collision::Intersection> intersection;  ///< Never null.
  std::string intersectionName;                           ///< As in the file; empty if it names none.
  std::optional<Box> region;
  double timeStep = 0.0;  ///< The step of a continuous method.
  std::vector<Remark> remarks;
};

/// An empty scene, with the default method: discrete, alarm distance 0.
[[nodiscard]] Scene emptyScene();

/// Appends the models of `more` to those of `scene`.
///
/// A model whose name exists in `scene` gets a number: "wheel#2". The first method and the first region
/// that a file names apply to all; others give a remark.
void append(Scene& scene, Scene more);

}  // namespace allpairs::scene
