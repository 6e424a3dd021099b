// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/scene/ReadOptions.h"
#include "allpairs/scene/Scene.h"
#include "sofa/mesh/Math.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {

/// What the elements of a collision model are.
enum class ModelShape { Points, Lines, Triangles, Tetrahedra, Spheres, Capsules, OrientedBoxes, Cells };

/// Everything that a scene says of one collision model, at the start of the simulation.
struct ModelDescription {
  std::string path;  ///< "/Node/Child/Name".
  std::string type;  ///< SOFA's class name, "TTriangleModel".
  ModelShape shape = ModelShape::Points;
  std::size_t owner = 0;  ///< Models of one node have the same.
  std::filesystem::path file;
  std::size_t line = 0;

  bool active = true;
  bool simulated = true;
  bool moving = true;
  bool selfCollision = false;
  bool useCurvature = false;
  std::set<int> groups;
  double contactDistance = 0;

  /// Points, corners, centres; for capsules the two ends of each, in turn.
  std::vector<Vec3> positions;
  std::vector<Quat> orientations;  ///< Of oriented boxes.
  Elements<2> lines;               ///< Of lines; of capsules: the two positions of each.
  Elements<3> triangles;
  Elements<4> tetrahedra;
  Elements<8> cells;
  std::vector<double> radii;      ///< Of spheres and capsules.
  std::vector<Vec3> halfExtents;  ///< Of oriented boxes.

  [[nodiscard]] std::size_t elementCount() const;
};

/// How the models are to be tested.
struct MethodDescription {
  std::string name;  ///< As the scene calls it; empty where it names none.
  double alarmDistance = 0;
  double contactDistance = 0;
  bool addsContactDistances = true;  ///< Those of the models, to the alarm distance; of methods that know them.
};

/// One collision pipeline of a scene: it tests its own models against one another, in its own way.
struct PipelineDescription {
  std::string path;                 ///< "/Node/Name"; empty where the scene has none.
  std::vector<std::size_t> models;  ///< Indices, in the order in which the pipeline takes its models.
  MethodDescription method;
  std::optional<Box> region;
};

/// What a scene holds for collision detection.
struct SceneDescription {
  std::vector<ModelDescription> models;        ///< In the order in which the pipelines take them.
  std::vector<std::string> owners;             ///< The paths of the nodes that models belong to.
  std::vector<PipelineDescription> pipelines;  ///< In the order in which SOFA runs them; at least one.
  std::vector<Remark> remarks;                 ///< Models that are missing, then those that no pipeline takes.
  std::vector<Remark> warnings;                ///< Where the result may not be what is expected; nothing is missing.
  std::vector<std::filesystem::path> inputs;   ///< All files that were read.
  int up = 2;                                  ///< Against the root's gravity, which pulls along -y by default.
};

/// Reads a .scn or .xml scene of SOFA.
///
/// Bad input: a scene that is malformed, refers to missing files, or holds a model whose place depends on something
///            that this reader does not know throws FileError with file, line, component and reason; with `partial`
///            such models are listed in `remarks`, and only a scene that cannot be read at all throws.
[[nodiscard]] SceneDescription describeScene(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace allpairs::scene::sofa
