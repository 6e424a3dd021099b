// SPDX-License-Identifier: MIT
#include "sofa/graph/ComponentKind.h"

#include <algorithm>
#include <cctype>
#include <unordered_map>

#include "input/Edits.h"

namespace allpairs::scene::sofa {
namespace {

using Table = std::unordered_map<std::string_view, ComponentClass>;
using enum ComponentKind;

void addModels(Table& table) {
  for (const auto name : {"PointModel", "PointCollisionModel", "TPointModel", "Point", "PointMesh", "PointSet"})
    table[name] = {PointModel, "TPointModel"};
  for (const auto name : {"LineModel", "LineCollisionModel", "TLineModel", "Line", "LineMesh", "LineSet",
                          "LineMeshModel", "LineSetModel"})
    table[name] = {LineModel, "TLineModel"};
  for (const auto name : {"TriangleModel", "TriangleCollisionModel", "TTriangleModel", "Triangle", "TriangleMesh",
                          "TriangleSet", "TriangleMeshModel", "TriangleSetModel"})
    table[name] = {TriangleModel, "TTriangleModel"};
  for (const auto name : {"TriangleOctreeModel", "TriangleOctree", "TriangleOctreeCollisionModel"})
    table[name] = {TriangleModel, "TriangleOctreeCollisionModel"};
  for (const auto name : {"BulletTriangleModel", "TBulletTriangleModel"})
    table[name] = {TriangleModel, "TBulletTriangleModel"};
  for (const auto name :
       {"SphereModel", "SphereCollisionModel", "TSphereModel", "Sphere", "CudaSphereModel", "CudaSphereCollisionModel"})
    table[name] = {SphereModel, "TSphereModel"};
  for (const auto name : {"CapsuleModel", "CapsuleCollisionModel", "TCapsuleModel", "Capsule", "RigidCapsule",
                          "RigidCapsuleModel", "RigidCapsuleCollisionModel"})
    table[name] = {CapsuleModel, "TCapsuleModel"};
  for (const auto name : {"CylinderModel", "CylinderCollisionModel", "TCylinderModel", "Cylinder"})
    table[name] = {CylinderModel, "TCylinderModel"};
  for (const auto name : {"OBB", "OBBModel", "TOBBModel", "OBBCollisionModel"})
    table[name] = {OrientedBoxModel, "TOBBModel"};
  for (const auto name : {"Tetrahedron", "TetrahedronModel", "TetrahedronCollisionModel"})
    table[name] = {TetrahedronModel, "TetrahedronModel"};
  for (const auto name : {"RigidDistanceGridCollisionModel", "DistanceGridCollisionModel"})
    table[name] = {RigidDistanceGrid, "RigidDistanceGridCollisionModel"};
  table["FFDDistanceGridCollisionModel"] = {DeformedDistanceGrid, "FFDDistanceGridCollisionModel"};
  for (const auto name : {"RigidSphere", "RigidSphereModel", "SpatialGridPointModel", "RayModel", "RayCollisionModel",
                          "Ray", "ImplicitSurfaceCollisionModel"})
    table[name] = {UnknownModel, {}};
}

void addPipeline(Table& table) {
  for (const auto name : {"DefaultPipeline", "CollisionPipeline"}) table[name] = {Pipeline, "DefaultPipeline"};
  table["CompositeCollisionPipeline"] = {CompositePipeline, "CompositeCollisionPipeline"};
  table["SubCollisionPipeline"] = {SubPipeline, "SubCollisionPipeline"};
  for (const auto name :
       {"BruteForceDetection", "BruteForceBroadPhase", "ParallelBruteForceBroadPhase", "AllpairsBroadPhase",
        "BruteForce", "DirectSAP", "IncrSAP", "IncrementalSAP", "RayTraceDetection"})
    table[name] = {BroadPhase, name};
  table["BulletCollisionDetection"] = {BroadPhase, {}};
  for (const auto name : {"DirectSAPNarrowPhase", "RayTraceNarrowPhase"}) table[name] = {NarrowPhase, name};
  for (const auto name : {"BVHNarrowPhase", "ParallelBVHNarrowPhase"}) table[name] = {NarrowPhase, {}};
  for (const auto name :
       {"CollisionResponse", "DefaultContactManager", "RuleBasedContactManager", "RuleBasedCollisionResponse"})
    table[name] = {ContactManager, {}};
  for (const auto name : {"DiscreteIntersection", "BulletIntersection"}) table[name] = {DiscreteMethod, name};
  for (const auto name : {"MinProximityIntersection", "NewProximityIntersection", "LocalMinDistance",
                          "CCDTightInclusionIntersection", "CudaProximityIntersection"})
    table[name] = {ProximityMethod, name};
}

void addTopologies(Table& table) {
  for (const auto name : {"MeshTopology", "Mesh"}) table[name] = {MeshTopology, "MeshTopology"};
  table["PointSetTopologyContainer"] = {PointContainer, "PointSetTopologyContainer"};
  table["EdgeSetTopologyContainer"] = {EdgeContainer, "EdgeSetTopologyContainer"};
  table["TriangleSetTopologyContainer"] = {TriangleContainer, "TriangleSetTopologyContainer"};
  table["QuadSetTopologyContainer"] = {QuadContainer, "QuadSetTopologyContainer"};
  table["TetrahedronSetTopologyContainer"] = {TetrahedronContainer, "TetrahedronSetTopologyContainer"};
  table["HexahedronSetTopologyContainer"] = {HexahedronContainer, "HexahedronSetTopologyContainer"};
  for (const auto name : {"RegularGridTopology", "RegularGrid"}) table[name] = {RegularGrid, "RegularGridTopology"};
  for (const auto name : {"SparseGridTopology", "SparseGrid", "SparseGridRamification",
                          "SparseGridRamificationTopology", "SparseGridMultiple", "SparseGridMultipleTopology"})
    table[name] = {SparseGrid, "SparseGridTopology"};
  for (const auto name : {"CubeTopology"}) table[name] = {CubeTopology, "CubeTopology"};
  for (const auto name : {"CylinderGridTopology", "CylinderGrid"}) table[name] = {CylinderGrid, "CylinderGridTopology"};
  for (const auto name : {"SphereGridTopology", "SphereGrid"}) table[name] = {SphereGrid, "SphereGridTopology"};
  for (const auto name : {"ManifoldEdgeSetTopologyContainer", "MultilevelHexahedronSetTopologyContainer",
                          "BezierTetrahedronSetTopologyContainer", "HighOrderTetrahedronSetTopologyContainer",
                          "HighOrderTriangleSetTopologyContainer", "SphereQuadTopology", "GridTopology", "Grid",
                          "DynamicSparseGridTopologyContainer"})
    table[name] = {UnknownTopology, {}};
}

void addMappings(Table& table) {
  table["Tetra2TriangleTopologicalMapping"] = {Tetra2Triangle, {}};
  table["Hexa2QuadTopologicalMapping"] = {Hexa2Quad, {}};
  table["Quad2TriangleTopologicalMapping"] = {Quad2Triangle, {}};
  table["Hexa2TetraTopologicalMapping"] = {Hexa2Tetra, {}};
  table["Triangle2EdgeTopologicalMapping"] = {Triangle2Edge, {}};
  table["Edge2QuadTopologicalMapping"] = {Edge2Quad, {}};
  table["Mesh2PointTopologicalMapping"] = {Mesh2Point, {}};
  table["SubsetTopologicalMapping"] = {Other, {}};  // It relates two topologies that are there, and fills neither.
  table["VoidMapping"] = {Other, {}};               // It moves nothing.
  for (const auto name : {"RigidMapping", "RigidRigidMapping"}) table[name] = {RigidMapping, name};
  for (const auto name : {"BeamLinearMapping", "BeamLinearMapping_mt"}) table[name] = {BeamLinearMapping, name};
  table["IdentityMapping"] = {IdentityMapping, "IdentityMapping"};
  table["SubsetMapping"] = {SubsetMapping, "SubsetMapping"};
  for (const auto name : {"BarycentricMapping", "TopologyBarycentricMapping"})
    table[name] = {BarycentricMapping, "BarycentricMapping"};
  table["IdentityMultiMapping"] = {IdentityMultiMapping, "IdentityMultiMapping"};
  table["SubsetMultiMapping"] = {SubsetMultiMapping, "SubsetMultiMapping"};
  table["DeformableOnRigidFrameMapping"] = {DeformableOnRigidFrameMapping, "DeformableOnRigidFrameMapping"};
  for (const auto name : {"SkinningMapping", "LinearBlendSkinningMapping"})
    table[name] = {SkinningMapping, "SkinningMapping"};
  table["CenterOfMassMapping"] = {CenterOfMassMapping, {}};
  table["ArticulatedSystemMapping"] = {ArticulatedMapping, {}};
  table["ArticulatedHierarchyContainer"] = {ArticulatedHierarchy, {}};
  table["ArticulationCenter"] = {ArticulationCenter, {}};
  table["Articulation"] = {Articulation, {}};
}

void addSources(Table& table) {
  table["MechanicalObject"] = {MechanicalState, "MechanicalObject"};
  for (const auto name : {"MeshObjLoader", "MeshOBJLoader", "MeshGmshLoader", "MeshVTKLoader", "MeshOffLoader",
                          "MeshTrianLoader", "MeshSTLLoader", "GridMeshCreator"})
    table[name] = {MeshLoader, name};
  for (const auto name : {"MeshXspLoader", "GIDMeshLoader", "StringMeshCreator", "VoxelGridLoader",
                          "MeshTetraStuffingLoader", "MeshSTEPLoader", "MeshLoader"})
    table[name] = {UnknownLoader, name};
  table["SphereLoader"] = {SphereLoader, "SphereLoader"};
  for (const auto name : {"TransformEngine"}) table[name] = {TransformEngine, name};
  table["MergePoints"] = {MergePoints, "MergePoints"};
  table["SubsetTopology"] = {SubsetTopology, "SubsetTopology"};
  table["BoxROI"] = {BoxRoi, "BoxROI"};
  table["QuatToRigidEngine"] = {QuatToRigid, "QuatToRigidEngine"};
  table["MeanComputation"] = {MeanComputation, "MeanComputation"};
  table["Spiral"] = {Spiral, "Spiral"};
  table["MeshTetraStuffing"] = {MeshTetraStuffing, "MeshTetraStuffing"};
  for (const auto name : {"RazerHydraDriver", "GeomagicDriver"}) table[name] = {Device, name};
}

const Table& knownClasses() {
  static const Table table = [] {
    Table classes;
    addModels(classes);
    addPipeline(classes);
    addTopologies(classes);
    addMappings(classes);
    addSources(classes);
    return classes;
  }();
  return table;
}

/// Collision models of plugins that do not say so in their names, such as TBulletSphereModel.
bool isPluginModel(std::string_view type) {
  const auto has = [type](std::string_view part) { return type.find(part) != std::string_view::npos; };
  if (!type.ends_with("Model") || type.starts_with("Ogl") || has("Visual") || has("Splat")) return false;
  return has("Sphere") || has("Point") || has("Line") || has("Triangle") || has("Capsule") || has("Cylinder") ||
         has("OBB") || has("ConvexHull");
}

}  // namespace

std::string_view similarClass(std::string_view type) {
  // Names of classes of SOFA that this reader does not need are shorter, or not so near.
  constexpr std::size_t kLeastLength = 10;
  constexpr std::size_t kMostEdits = 2;
  if (knownClasses().contains(type)) return {};
  std::string_view nearest;
  std::size_t edits = kMostEdits + 1;
  for (const auto& [name, what] : knownClasses()) {
    if (name.size() < kLeastLength || type.size() > name.size() + kMostEdits || name.size() > type.size() + kMostEdits)
      continue;
    const std::size_t found = editsBetween(type, name);
    if (found > edits || (found == edits && name > nearest)) continue;
    edits = found;
    nearest = name;
  }
  return edits <= kMostEdits ? nearest : std::string_view{};
}

ComponentClass classOf(std::string_view type) {
  const auto& classes = knownClasses();
  if (const auto found = classes.find(type); found != classes.end()) return found->second;
  if (type.ends_with("TopologicalMapping")) return {UnknownTopologicalMapping, {}};
  if (type.ends_with("Mapping")) return {UnknownMapping, {}};
  if (type.ends_with("CollisionModel") || isPluginModel(type)) return {UnknownModel, {}};
  if (type.ends_with("TopologyContainer") || type.ends_with("Topology")) return {UnknownTopology, {}};
  if (type.ends_with("Intersection")) return {OtherMethod, {}};
  return {};
}

std::string defaultNameStem(std::string_view type) {
  if (type == "MechanicalObject") return "mObject";
  std::string stem{classOf(type).name};
  if (!stem.empty()) stem[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(stem[0])));
  return stem;
}

}  // namespace allpairs::scene::sofa
