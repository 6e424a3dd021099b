// SPDX-License-Identifier: MIT
// Coordinates are those of the file, and which axis is up is what its format says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "allpairs/scene/ReadInput.h"
#include "allpairs/scene/WriteResult.h"
#include "support/IfcText.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

scene::Scene readFrame(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  scene::Scene scene = scene::readInput(folder.write(name, bytes));
  for (const auto& model : scene.models) model->computeBoundingTree();
  return scene;
}

Box boxOfModel(const scene::Scene& scene, std::size_t model) { return scene::modelRecord(*scene.models.at(model)).box; }

/// A triangle in COLLADA, from (1, 2, 3) on.
std::string collada(const std::string& up) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="cm" meter="0.01"/>)" +
         up + R"(</asset><library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="a" count="9">1 2 3 5 2 3 1 9 4</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s" name="s"><node id="n" name="n">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// The same in FBX, which numbers the axis that is up; one that it has not is none.
std::string fbx(int up, const std::string& unit = {}) {
  return "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7300\n}\n"
         "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\"," +
         std::to_string(up) + unit + R"(
	}
}
Objects:  {
	Geometry: 100, "Geometry::g", "Mesh" {
		Vertices: *9 {
			a: 1,2,3,5,2,3,1,9,4
		}
		PolygonVertexIndex: *3 {
			a: 0,1,-3
		}
		GeometryVersion: 124
	}
	Model: 200, "Model::m", "Mesh" {
		Version: 232
	}
}
Connections:  {
	C: "OO",200,0
	C: "OO",100,200
}
)";
}

constexpr const char* kTriangleInX3d = R"(<?xml version="1.0" encoding="UTF-8"?>
<X3D profile="Interchange" version="3.0"><Scene><Shape><IndexedFaceSet coordIndex="0 1 2 -1">
<Coordinate point="1 2 3 5 2 3 1 9 4"/></IndexedFaceSet></Shape></Scene></X3D>)";

/// A chunk of a 3DS file: its kind, its length and what is in it.
std::string chunk(std::uint16_t kind, const std::string& content) {
  std::string bytes;
  appendNumber(bytes, kind, false);
  appendNumber(bytes, static_cast<std::uint32_t>(6 + content.size()), false);
  return bytes + content;
}

/// The same triangle in 3DS, with a scale of the whole, if it is given one.
std::string triangleIn3ds(std::optional<float> masterScale = {}) {
  std::string scale;
  if (masterScale) appendNumber(scale, *masterScale, false);
  if (masterScale) scale = chunk(0x0100, scale);
  std::string vertices;
  appendNumber(vertices, std::uint16_t{3}, false);
  for (const float x : {1.0F, 2.0F, 3.0F, 5.0F, 2.0F, 3.0F, 1.0F, 9.0F, 4.0F}) appendNumber(vertices, x, false);
  std::string faces;
  for (const int number : {1, 0, 1, 2, 7}) appendNumber(faces, static_cast<std::uint16_t>(number), false);
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces));
  return chunk(0x4D4D, chunk(0x3D3D, scale + chunk(0x4000, std::string("part") + '\0' + mesh)));
}

constexpr const char* kTriangleInDxf =
    "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\nwalls\n10\n1\n20\n2\n30\n3\n11\n5\n21\n2\n31\n3\n12\n1\n22\n9\n32\n4\n"
    "13\n1\n23\n9\n33\n4\n0\nENDSEC\n0\nEOF\n";

constexpr const char* kTriangleInAse = R"(*3DSMAX_ASCIIEXPORT 200
*GEOMOBJECT {
	*NODE_NAME "part"
	*MESH {
		*MESH_NUMVERTEX 3
		*MESH_NUMFACES 1
		*MESH_VERTEX_LIST {
			*MESH_VERTEX 0 1 2 3
			*MESH_VERTEX 1 5 2 3
			*MESH_VERTEX 2 1 9 4
		}
		*MESH_FACE_LIST {
			*MESH_FACE 0: A: 0 B: 1 C: 2 AB: 1 BC: 1 CA: 1 *MESH_SMOOTHING 0 *MESH_MTLID 0
		}
	}
}
)";

constexpr const char* kTriangleInDirectX = "xof 0303txt 0032\nMesh m { 3; 1;2;3;, 5;2;3;, 1;9;4;; 1; 3;0,1,2;; }\n";

std::string amf(const std::string& attributes) {
  return "<?xml version=\"1.0\"?>\n<amf" + attributes +
         R"(><object id="1"><mesh><vertices>
<vertex><coordinates><x>1</x><y>2</y><z>3</z></coordinates></vertex>
<vertex><coordinates><x>5</x><y>2</y><z>3</z></coordinates></vertex>
<vertex><coordinates><x>1</x><y>9</y><z>4</z></coordinates></vertex></vertices>
<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object></amf>)";
}

constexpr const char* kTriangleInGltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

std::string sofa(const std::string& attributes) {
  return "<Node name=\"root\" " + attributes +
         "><CollisionPipeline/><DiscreteIntersection/><Node name=\"a\"><MechanicalObject position=\"0 0 0\"/>"
         "<SphereCollisionModel radius=\"1\"/></Node></Node>";
}

TEST(Frame, AnIfcHasTheCoordinatesOfItsFile) {
  const scene::Scene scene = readFrame("two.ifc", kIfc);
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_EQ(boxOfModel(scene, 0), (Box{{0, 0, 0}, {4000, 1000, 3000}}));
  EXPECT_EQ(boxOfModel(scene, 1), (Box{{3900, 0, 0}, {4900, 1000, 5000}}));
  EXPECT_EQ(scene.up, 3);
  EXPECT_EQ(scene.metresPerUnit, 0.001);
}

TEST(Frame, AColladaFileHasTheCoordinatesOfItsFileWhicheverAxisIsUp) {
  const std::vector<std::pair<std::string, int>> axes{
      {"", 2}, {"<up_axis>Y_UP</up_axis>", 2}, {"<up_axis>Z_UP</up_axis>", 3}, {"<up_axis>X_UP</up_axis>", 1}};
  for (const auto& [axis, up] : axes) {
    const scene::Scene scene = readFrame("a.dae", collada(axis));
    EXPECT_EQ(boxOfModel(scene, 0), (Box{{1, 2, 3}, {5, 9, 4}})) << axis;
    EXPECT_EQ(scene.up, up) << axis;
    EXPECT_EQ(scene.metresPerUnit, 0.01) << axis;
  }
}

TEST(Frame, OtherFormatsHaveTheCoordinatesOfTheirFilesAndTheirAxis) {
  const std::vector<std::pair<scene::Scene, int>> scenes = [] {
    std::vector<std::pair<scene::Scene, int>> read;
    for (int axis = -1; axis < 4; ++axis) {
      read.emplace_back(readFrame("a.fbx", fbx(axis)), axis >= 0 && axis < 3 ? axis + 1 : 0);
    }
    read.emplace_back(readFrame("a.x3d", kTriangleInX3d), 2);
    read.emplace_back(readFrame("a.3ds", triangleIn3ds()), 3);
    read.emplace_back(readFrame("a.3ds", triangleIn3ds(2.0F)), 3);
    read.emplace_back(readFrame("a.dxf", kTriangleInDxf), 3);
    read.emplace_back(readFrame("a.ase", kTriangleInAse), 3);
    read.emplace_back(readFrame("a.x", kTriangleInDirectX), 0);
    return read;
  }();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& [scene, up] = scenes[i];
    ASSERT_EQ(scene.models.size(), 1U) << i;
    EXPECT_EQ(boxOfModel(scene, 0), (Box{{1, 2, 3}, {5, 9, 4}})) << i;
    EXPECT_EQ(scene.up, up) << i;
    EXPECT_EQ(scene.metresPerUnit, std::nullopt) << i;
  }
}

TEST(Frame, FbxAndAmfHaveTheUnitThatTheyName) {
  const auto unit = [](const std::string& name, const std::string& bytes) {
    return readFrame(name, bytes).metresPerUnit;
  };
  const std::string property = "\n\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",";
  EXPECT_EQ(unit("a.fbx", fbx(1, property + "1")), 0.01);
  EXPECT_EQ(unit("a.fbx", fbx(1, property + "2.54")), 0.0254);
  EXPECT_EQ(unit("a.fbx", fbx(1, "\n\t\tP: \"OriginalUnitScaleFactor\", \"double\", \"Number\", \"\",1")),
            std::nullopt);
  EXPECT_EQ(unit("a.amf", amf(" version=\"1.1\" unit=\"inch\"")), 0.0254);
  EXPECT_EQ(unit("a.amf", amf("")), 0.001);
  EXPECT_EQ(unit("a.amf", amf(" unit='meter'")), 1.0);
  EXPECT_EQ(unit("a.amf", amf(" generator=\"a>b unity\" unit=\"inch\"")), 0.0254);
  EXPECT_EQ(unit("a.amf", "<!-- <amf unit='meter'> -->" + amf("").substr(22)), 0.001);
}

TEST(Frame, GltfIsYUpAndInMetresAndStlSaysNothing) {
  const scene::Scene scene = readFrame("a.gltf", kTriangleInGltf);
  EXPECT_EQ(scene.up, 2);
  EXPECT_EQ(scene.metresPerUnit, 1.0);
  const scene::Scene plain = readFrame("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(plain.up, 0);
  EXPECT_EQ(plain.metresPerUnit, std::nullopt);
}

TEST(Frame, ASofaSceneIsUpAgainstItsGravity) {
  EXPECT_EQ(readFrame("a.scn", sofa("")).up, 2);
  EXPECT_EQ(readFrame("a.scn", sofa("gravity=\"0 0 -9.81\"")).up, 3);
  EXPECT_EQ(readFrame("a.scn", sofa("gravity=\"0 9.81 0.5\"")).up, -2);
  EXPECT_EQ(readFrame("a.scn", sofa("gravity=\"0 0 0\"")).up, 2);
}

TEST(Frame, TheFirstInputThatSaysWhatIsUpSaysItForAll) {
  scene::Scene scene = readFrame("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  append(scene, readFrame("two.ifc", kIfc));
  append(scene, readFrame("a.gltf", kTriangleInGltf));
  EXPECT_EQ(scene.up, 3);
  EXPECT_EQ(scene.metresPerUnit, 0.001);
}

TEST(Frame, FilesThatSayOtherwiseThanThoseBeforeThemAreNamedOnce) {
  const TempFolder folder;
  folder.write("1.ifc", kIfc);
  folder.write("2.gltf", kTriangleInGltf);
  folder.write("3.dae", collada("<up_axis>X_UP</up_axis>"));
  folder.write("4.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const scene::Scene scene = scene::readInput(folder.path());
  ASSERT_EQ(scene.warnings.size(), 2U);
  EXPECT_EQ(scene.warnings[0].file.filename(), "2.gltf");
  EXPECT_EQ(scene.warnings[0].subject, "axes");
  EXPECT_EQ(scene.warnings[0].reason,
            "y points up in this file, z in a file before it; coordinates are compared as they are");
  EXPECT_EQ(scene.warnings[1].subject, "unit");
  EXPECT_EQ(scene.warnings[1].reason,
            "1 metre in this file, 0.001 metres in a file before it; coordinates are compared as they are");
  EXPECT_TRUE(readFrame("two.ifc", kIfc).warnings.empty());
}

TEST(Frame, OfAFolderTheFileIsNamedThatSaysSo) {
  const TempFolder folder;
  folder.write("mix/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("mix/z.ifc", kIfc);
  scene::Scene scene = readFrame("a.gltf", kTriangleInGltf);
  append(scene, scene::readInput(folder.path() / "mix"));
  ASSERT_EQ(scene.warnings.size(), 2U);
  for (const scene::Remark& warning : scene.warnings) EXPECT_EQ(warning.file.filename(), "z.ifc") << warning.subject;
}

TEST(Frame, AFileThatSaysNothingIsNoOther) {
  const TempFolder folder;
  folder.write("1.gltf", kTriangleInGltf);
  folder.write("2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(scene::readInput(folder.path()).warnings.empty());
}

TEST(Frame, UnitsThatDifferByMoreThanRoundingAreNamed) {
  std::string other = collada("");
  other.replace(other.find("0.01"), 4, "0.01001");
  const TempFolder folder;
  folder.write("1.dae", collada(""));
  folder.write("2.dae", other);
  const scene::Scene scene = scene::readInput(folder.path());
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_EQ(scene.warnings[0].subject, "unit");
}

}  // namespace
}  // namespace allpairs::test
