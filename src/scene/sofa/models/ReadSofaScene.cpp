// SPDX-License-Identifier: MIT
#include <span>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/LocalMinDistance.h"
#include "allpairs/collision/MeshModel.h"
#include "allpairs/collision/MinProximityIntersection.h"
#include "allpairs/collision/NewProximityIntersection.h"
#include "allpairs/collision/OrientedBoxModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadSofaScene.h"
#include "input/ModelNames.h"
#include "sofa/models/ModelDescription.h"

namespace allpairs::scene {
namespace {

using Model = std::unique_ptr<collision::CollisionModel>;

/// SOFA's cylinders have the boxes of capsules, under a name of their own.
class CylinderModel final : public collision::CapsuleModel {
 public:
  using CapsuleModel::CapsuleModel;

  [[nodiscard]] std::string_view typeName() const override { return "TCylinderModel"; }
};

/// Some classes of SOFA, such as octrees of triangles, have the boxes of triangle models, under names of their own.
class NamedTriangleModel final : public collision::TriangleModel {
 public:
  NamedTriangleModel(sofa::ModelDescription& model)
      : TriangleModel(model.path, std::move(model.positions), std::move(model.triangles)), m_type(model.type) {}

  [[nodiscard]] std::string_view typeName() const override { return m_type; }

 private:
  std::string m_type;
};

/// Cells of eight points each, bounded without the contact distance; SOFA's distance grids.
class CellModel final : public collision::MeshModel {
 public:
  CellModel(std::string name, std::string type, std::vector<collision::Vec3> positions, sofa::Elements<8> cells)
      : MeshModel(std::move(name), std::move(positions)), m_type(std::move(type)), m_cells(std::move(cells)) {
    for (std::size_t i = 0; i < m_cells.size(); ++i) checkVertices(m_cells[i], i);
  }

  [[nodiscard]] std::size_t getSize() const override { return m_cells.size(); }
  [[nodiscard]] std::string_view typeName() const override { return m_type; }

 protected:
  [[nodiscard]] Span<const std::uint32_t> verticesOf(std::size_t index, std::uint32_t& /*storage*/) const override {
    return m_cells[index];
  }
  [[nodiscard]] double margin() const override { return 0.0; }

 private:
  std::string m_type;
  sofa::Elements<8> m_cells;
};

Model makeOrientedBoxes(sofa::ModelDescription& model) {
  std::vector<collision::OrientedBox> boxes(model.positions.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto& turn = model.orientations[i];
    const auto axis = [&](const sofa::Vec3& unit) { return sofa::rotate(turn, unit); };
    boxes[i] = {model.positions[i], {axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1})}, model.halfExtents[i]};
  }
  return std::make_unique<collision::OrientedBoxModel>(model.path, std::move(boxes));
}

Model makeCapsules(sofa::ModelDescription& model) {
  std::vector<collision::Capsule> capsules(model.lines.size());
  for (std::size_t i = 0; i < capsules.size(); ++i)
    capsules[i] = {model.positions[model.lines[i][0]], model.positions[model.lines[i][1]], model.radii[i]};
  if (model.type == "TCylinderModel") return std::make_unique<CylinderModel>(model.path, std::move(capsules));
  return std::make_unique<collision::CapsuleModel>(model.path, std::move(capsules));
}

Model makeTriangles(sofa::ModelDescription& model) {
  std::unique_ptr<collision::TriangleModel> triangles;
  if (model.type == "TTriangleModel")
    triangles =
        std::make_unique<collision::TriangleModel>(model.path, std::move(model.positions), std::move(model.triangles));
  else
    triangles = std::make_unique<NamedTriangleModel>(model);
  triangles->setUseCurvature(model.useCurvature);
  return triangles;
}

Model makeElements(sofa::ModelDescription& model) {
  using enum sofa::ModelShape;
  switch (model.shape) {
    case Lines:
      return std::make_unique<collision::LineModel>(model.path, std::move(model.positions), std::move(model.lines));
    case Triangles:
      return makeTriangles(model);
    case Tetrahedra:
      return std::make_unique<collision::TetrahedronModel>(model.path, std::move(model.positions),
                                                           std::move(model.tetrahedra));
    case Spheres:
      return std::make_unique<collision::SphereModel>(model.path, std::move(model.positions), std::move(model.radii));
    case Capsules:
      return makeCapsules(model);
    case OrientedBoxes:
      return makeOrientedBoxes(model);
    case Cells:
      return std::make_unique<CellModel>(model.path, model.type, std::move(model.positions), std::move(model.cells));
    case Points:
      break;
  }
  return std::make_unique<collision::PointModel>(model.path, std::move(model.positions));
}

Model makeModel(sofa::ModelDescription& description) {
  auto model = makeElements(description);
  model->setActive(description.active);
  model->setSimulated(description.simulated);
  model->setMoving(description.moving);
  model->setSelfCollision(description.selfCollision);
  model->setGroups({description.groups.begin(), description.groups.end()});
  model->setContactDistance(description.contactDistance);
  return model;
}

using Kept = std::vector<std::optional<std::size_t>>;

/// Where each described model is in the scene; nothing for those that were left out.
Kept addModels(sofa::SceneDescription& description, bool partial, Scene& scene) {
  Kept kept;
  for (auto& model : description.models) {
    try {
      scene.models.push_back(makeModel(model));
      scene.models.back()->setOwner(scene.owners[model.owner].get());
      kept.emplace_back(scene.models.size() - 1);
    } catch (const Error& problem) {  // What only the model itself checks: a negative radius, say.
      if (!partial) throw FileError(model.file, problem.what(), model.line);
      scene.remarks.push_back({model.file, model.line, model.path, problem.what(), true});
      kept.emplace_back();
    }
  }
  return kept;
}

/// Methods that differ from another in their narrow phase only, under names of their own.
class CcdTightInclusionIntersection final : public collision::NewProximityIntersection {
 public:
  [[nodiscard]] std::string_view typeName() const override { return "CCDTightInclusionIntersection"; }
};

class CudaProximityIntersection final : public collision::NewProximityIntersection {
 public:
  [[nodiscard]] std::string_view typeName() const override { return "CudaProximityIntersection"; }
};

std::unique_ptr<collision::Intersection> makeMethod(const sofa::MethodDescription& method) {
  std::unique_ptr<collision::Intersection> result;
  if (method.name == "MinProximityIntersection")
    result = std::make_unique<collision::MinProximityIntersection>();
  else if (method.name == "NewProximityIntersection")
    result = std::make_unique<collision::NewProximityIntersection>();
  else if (method.name == "CCDTightInclusionIntersection")
    result = std::make_unique<CcdTightInclusionIntersection>();
  else if (method.name == "CudaProximityIntersection")
    result = std::make_unique<CudaProximityIntersection>();
  else if (method.name == "LocalMinDistance")
    result = std::make_unique<collision::LocalMinDistance>();
  else
    result = std::make_unique<collision::DiscreteIntersection>();
  result->setAlarmDistance(method.alarmDistance);
  result->setContactDistance(method.contactDistance);
  if (auto* proximity = dynamic_cast<collision::ProximityIntersection*>(result.get()))
    proximity->setContactDistanceInBroadPhase(method.addsContactDistances);
  return result;
}

ScenePipeline makePipeline(sofa::PipelineDescription& description, const Kept& kept) {
  ScenePipeline pipeline{.name = std::move(description.path),
                         .intersection = makeMethod(description.method),
                         .intersectionName = description.method.name,
                         .region = description.region};
  for (const std::size_t model : description.models)
    if (kept[model]) pipeline.models.push_back(*kept[model]);
  return pipeline;
}

}  // namespace

Scene readSofaScene(const std::filesystem::path& path, const ReadOptions& options) {
  auto description = sofa::describeScene(path, options);
  const auto& first = description.pipelines.front();
  Scene scene;
  scene.intersection = makeMethod(first.method);
  scene.intersectionName = first.method.name;
  scene.region = first.region;
  scene.up = description.up;
  for (auto& owner : description.owners) scene.owners.push_back(std::make_unique<Owner>(Owner{std::move(owner)}));
  scene.remarks = std::move(description.remarks);
  scene.warnings = std::move(description.warnings);
  const Kept kept = addModels(description, options.partial, scene);
  noteSources(scene, path);
  scene.inputs = std::move(description.inputs);
  if (description.pipelines.size() > 1)
    for (auto& pipeline : description.pipelines) scene.pipelines.push_back(makePipeline(pipeline, kept));
  return scene;
}

}  // namespace allpairs::scene
