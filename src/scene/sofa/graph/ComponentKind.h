// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace allpairs::scene::sofa {

/// What a component of a scene is to this reader.
enum class ComponentKind {
  Other,  ///< Nothing that a collision model's position depends on, as far as its name tells.
  Pipeline,
  CompositePipeline,
  SubPipeline,
  BroadPhase,
  NarrowPhase,
  ContactManager,
  DiscreteMethod,
  ProximityMethod,
  OtherMethod,
  MechanicalState,
  MeshLoader,
  SphereLoader,
  UnknownLoader,
  MeshTopology,
  PointContainer,
  EdgeContainer,
  TriangleContainer,
  QuadContainer,
  TetrahedronContainer,
  HexahedronContainer,
  RegularGrid,
  SparseGrid,
  CubeTopology,
  CylinderGrid,
  SphereGrid,
  UnknownTopology,
  Tetra2Triangle,
  Hexa2Quad,
  Quad2Triangle,
  Hexa2Tetra,
  Triangle2Edge,
  Edge2Quad,
  Mesh2Point,
  UnknownTopologicalMapping,
  RigidMapping,
  BeamLinearMapping,
  IdentityMapping,
  SubsetMapping,
  BarycentricMapping,
  IdentityMultiMapping,
  SubsetMultiMapping,
  DeformableOnRigidFrameMapping,
  SkinningMapping,
  CenterOfMassMapping,
  ArticulatedMapping,
  UnknownMapping,
  TransformEngine,
  MergePoints,
  BoxRoi,
  SubsetTopology,
  QuatToRigid,
  MeanComputation,
  Spiral,
  MeshTetraStuffing,
  Device,
  ArticulatedHierarchy,
  ArticulationCenter,
  Articulation,
  PointModel,
  LineModel,
  TriangleModel,
  SphereModel,
  CapsuleModel,
  CylinderModel,
  OrientedBoxModel,
  TetrahedronModel,
  RigidDistanceGrid,
  DeformedDistanceGrid,
  UnknownModel,
};

/// What the class names in a scene stand for.
struct ComponentClass {
  ComponentKind kind = ComponentKind::Other;
  std::string_view name;  ///< SOFA's own class name, whatever alias the scene uses; empty where this reader has none.
};

/// The class behind a name in a scene, of either generation of SOFA, alias or not.
[[nodiscard]] ComponentClass classOf(std::string_view type);

/// The name of a class that is so near to a name which this reader does not know that it is likely to be meant; empty
/// for none.
[[nodiscard]] std::string_view similarClass(std::string_view type);

/// The stem of the names that SOFA gives to components without a name; empty for classes that it would not know.
[[nodiscard]] std::string defaultNameStem(std::string_view type);

}  // namespace allpairs::scene::sofa
