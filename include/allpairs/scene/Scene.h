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

/// A remark on one line: "parts/a.stl:3: hull: why".
[[nodiscard]] std::string textOf(const Remark& remark);

/// The owner of models: a node of a scene, an object of a mesh file. Models of one owner are one body.
struct Owner {
  std::string path;
};

/// Where a model comes from.
struct ModelSource {
  std::size_t file = 0;  ///< An index into Scene::files.
  /// As the file has it, behind the nodes that it is in as far as they tell it from others of its name: "bolt", "left
  /// door/bolt"; a file's name where it has none. Numbered where that is not enough: "bolt#2".
  std::string name{};
  std::string kind{};   ///< What it is in the format's own words: "IfcColumn"; else empty.
  std::string id{};     ///< What identifies it for good, an IFC's GlobalId; else empty.
  std::string given{};  ///< What append() or a reader of several files named the model last; empty: as the file has it.
  /// The body of its file that it is a part of besides its owner: an IFC's product, of which mapped items are parts;
  /// else empty.
  std::string body{};
  /// The assembly that it is in: in IFC the outermost product, else what is below the node of the file where it first
  /// branches.
  std::string assembly{};
  std::string assemblyId{};  ///< What identifies that for good, an IFC's GlobalId; else empty.
  /// Where it is in its file: the names of all nodes that it is in, the outermost first, and its own, "car/left
  /// door/bolt"; those of one name in the same node are numbered. Empty in files whose objects are not nested, or not
  /// in nodes that have names.
  std::string path{};
};

/// One of several collision pipelines of a scene: it tests its own models against one another, in its own way.
struct ScenePipeline {
  std::string name{};                 ///< As in the file: "/Node/Name".
  std::vector<std::size_t> models{};  ///< Indices into Scene::models, in the order in which the pipeline takes them.
  std::unique_ptr<collision::Intersection> intersection{};  ///< Never null.
  std::string intersectionName{};                           ///< As in the file; empty if it names none.
  std::optional<Box> region{};
};

/// The result of a reader: collision models in the order of traversal, and the intersection method.
struct Scene {
  std::vector<std::unique_ptr<collision::CollisionModel>> models;
  std::vector<std::unique_ptr<Owner>> owners;
  std::vector<std::filesystem::path> files{};  ///< What models were read from, in the order in which it was read.
  std::vector<ModelSource> sources{};          ///< Of each model; models behind the last one are of no file.
  std::vector<std::filesystem::path>
      inputs{};  ///< The files that were read for it; not those that a file for Assimp names.
  std::unique_ptr<collision::Intersection> intersection;  ///< Never null.
  std::string intersectionName;                           ///< As in the file; empty if it names none.
  std::optional<Box> region;
  double timeStep = 0.0;  ///< The step of a continuous method.
  std::vector<Remark> remarks;
  std::vector<Remark> warnings{};  ///< Where the result may not be what is expected, though no part was skipped.
  /// Where a scene has several: searchesOf() gives each its models, and the method and region above are the first's.
  std::vector<ScenePipeline> pipelines{};
  /// The axis that points up, where the format or its gravity says so: 1 to 3 for x to z, below 0 for the other way;
  /// else 0.
  int up = 0;
  std::optional<double> metresPerUnit{};  ///< The length of a unit, where the format says so.
  std::filesystem::path frameFile{};      ///< The first file whose format says either.
};

/// One search of a scene: models that are tested against one another, and how.
struct SceneSearch {
  std::vector<std::size_t> indices{};                ///< Of the models in Scene::models.
  std::vector<collision::CollisionModel*> models{};  ///< In the order in which they are to be added.
  collision::Intersection* intersection = nullptr;   ///< Never null.
  std::optional<Box> region{};
};

/// The searches that give a scene's pairs: one for each of its pipelines, or one of all models.
///
/// The result refers to the scene. Two pipelines may share models: a pair that both find is a pair of both.
[[nodiscard]] std::vector<SceneSearch> searchesOf(const Scene& scene);

/// An empty scene, with the default method: discrete, alarm distance 0.
[[nodiscard]] Scene emptyScene();

/// Appends the models of `more` to those of `scene`.
///
/// Where files have objects of the same name, or of one that says nothing, such as "default" or "Cylinder.002", their
/// models are named by file and object: "left.obj › wheel"; where the object's name says nothing and it is alone in its
/// file, by the file alone: "left.obj". Models of the same name that this does not tell apart get a number: "wheel#2".
/// Names that setName() has given since stay. The first method and the
/// first region that a file names apply to all; others give a remark. The first input that says which axis is up, and
/// how long a unit is, says it for all: coordinates are not converted, and others give a warning.
///
/// Bad input: where one of the two has several pipelines, throws InvalidArgument, which names its file: each has its
///            models and its method, and nothing says which of them would take the others.
/// Cost:      linear in the models of both, since any of them may get another name. Append many scenes together.
void append(Scene& scene, Scene more);

/// Appends the models of several scenes, in order, as appending one after the other does, but names all models once.
///
/// Bad input: as of append() of one; nothing is appended then.
/// Cost:      linear in the models of all.
void append(Scene& scene, std::vector<Scene> more);

}  // namespace allpairs::scene
