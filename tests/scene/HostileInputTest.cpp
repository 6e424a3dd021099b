// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "Expect.h"
#include "SceneText.h"
#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/ReadInput.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr const char* kSecret = "SECRET_TOKEN=1 v f 2 3\n";

std::string repeated(const std::string& text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

/// A triangle whose 36 bytes of positions are in a file of this name.
std::string gltfOf(const std::string& uri) {
  return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": ")" +
         uri + "\"}]}";
}

std::string sceneOf(const std::string& components) {
  return "<Node name='root'>\n" + components + "<MechanicalObject/><TriangleModel name='t'/></Node>";
}

/// What reading a file complains of; empty where it is read.
std::string complaint(const fs::path& path, const scene::ReadOptions& options = {}) {
  try {
    (void)scene::readInput(path, options);
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

void expectHolds(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks: " << part;
}

/// A folder with an input folder "in", and beside it files that no input may name.
class Containment : public testing::Test {
 protected:
  Containment() {
    fs::create_directory(m_folder.path() / "in");
    m_folder.write("outside.bin", std::string(36, '\0'));
    m_folder.write("outside.obj", kObj);
    m_folder.write("outside.xml", "<Node name='x'/>");
    m_folder.write("outside.dae", "<COLLADA/>");
    fs::create_symlink("../outside.bin", m_folder.path() / "in/link.bin");
    fs::create_symlink("../outside.obj", m_folder.path() / "in/link.obj");
  }

  fs::path input(const std::string& name, const std::string& text) const { return m_folder.write("in/" + name, text); }

  void expectContained(const fs::path& path, const std::string& name, const std::string& element) const {
    const std::string said = complaint(path);
    expectHolds(said, path.string());
    expectHolds(said, element);
    expectHolds(said, "'" + name + "' lies outside");
    expectHolds(said, "--allow-outside");
    EXPECT_EQ(complaint(path, {.allowOutside = true}), "");
    EXPECT_EQ(complaint(path, {.searchRoots = {m_folder.path()}}), "");
  }

  TempFolder m_folder;
};

TEST_F(Containment, BuffersOfAGltfFileStayInItsFolder) {
  for (const std::string& uri : {std::string("../outside.bin"), std::string("link.bin"),
                                 std::string("%2e%2e/outside.bin"), (m_folder.path() / "outside.bin").string()}) {
    expectContained(input("a.gltf", gltfOf(uri)), uri, "buffer 0");
  }
  input("inside.bin", std::string(36, '\0'));
  EXPECT_EQ(complaint(input("a.gltf", gltfOf("inside.bin"))), "");
}

TEST_F(Containment, FilesThatASceneNamesStayInItsFolder) {
  for (const std::string& name :
       {std::string("../outside.obj"), std::string("link.obj"), (m_folder.path() / "outside.obj").string()}) {
    expectContained(input("a.scn", sceneOf("<MeshTopology name='m' filename='" + name + "'/>")), name,
                    ":2: MeshTopology 'm' (/m)");
  }
  expectContained(
      input("a.scn", sceneOf("<include href='../outside.xml'/><MeshTopology position='0 0 0' triangles='0 0 0'/>")),
      "../outside.xml", ":2: the included file");
}

TEST_F(Containment, WhetherAFileOutsideIsThereIsNotSaid) {
  expectHolds(complaint(input("a.gltf", gltfOf("../gone.bin"))), "'../gone.bin' lies outside");
}

TEST_F(Containment, LinksInAFolderOfMeshesStayInIt) {
  expectHolds(complaint(m_folder.path() / "in"), "link.obj: is a link to a file outside");
  EXPECT_EQ(scene::readInput(m_folder.path() / "in", {.partial = true, .allowOutside = true}).models.size(), 1U);
}

TEST_F(Containment, PipesAndDevicesAreRefusedAndNotWaitedFor) {
  ASSERT_EQ(::mkfifo((m_folder.path() / "in/pipe.obj").c_str(), 0600), 0);
  expectHolds(complaint(m_folder.path() / "in/pipe.obj"), "is not a regular file");
  expectHolds(complaint(input("a.gltf", gltfOf("pipe.obj"))), "'pipe.obj' is not a regular file");
  expectHolds(complaint(input("a.scn", sceneOf("<MeshTopology filename='pipe.obj'/>"))), "is not a regular file");
  expectHolds(complaint(input("a.scn", sceneOf("<include href='pipe.obj'/>"))), "is not a regular file");
  expectHolds(complaint(input("a.gltf", gltfOf("/dev/zero")), {.allowOutside = true}), "is not a regular file");
}

TEST_F(Containment, NoMessageRepeatsWhatIsInAFileOfAnotherKind) {
  for (const char* extension : {"obj", "off", "trian", "msh", "sph", "vtk", "vtu", "stl", "xml"}) {
    const std::string name = std::string("secret.") + extension;
    input(name, kSecret);
    for (const std::string& component : {"<MeshTopology filename='" + name + "'/>",
                                         "<MeshOffLoader name='l' filename='" + name + "'/><MeshTopology src='@l'/>",
                                         "<MeshObjLoader name='l' filename='" + name + "'/><MeshTopology src='@l'/>",
                                         "<MeshGmshLoader name='l' filename='" + name + "'/><MeshTopology src='@l'/>",
                                         "<MeshVTKLoader name='l' filename='" + name + "'/><MeshTopology src='@l'/>",
                                         "<MeshTrianLoader name='l' filename='" + name + "'/><MeshTopology src='@l'/>",
                                         "<include href='" + name + "'/>"}) {
      const std::string said = complaint(input("a.scn", sceneOf(component)));
      const bool isRead = !component.starts_with("<MeshTopology") || name.ends_with(".obj") || name.ends_with(".msh");
      EXPECT_EQ(said != "", isRead) << component;
      EXPECT_EQ(said.find("SECRET"), std::string::npos) << said;
    }
  }
}

TEST_F(Containment, AnObjWithoutFacesGivesAModelWithoutTrianglesAndAWarning) {
  input("cloud.obj", "v 0 0 0\nv 1 0 0\n");
  for (const std::string component : {"<MeshTopology filename='cloud.obj'/>",
                                      "<MeshObjLoader name='l' filename='cloud.obj'/><MeshTopology src='@l'/>"}) {
    const auto scene = scene::readInput(input("a.scn", sceneOf(component)));
    EXPECT_EQ(scene.models.size(), 1U);
    std::string said;
    for (const auto& warning : scene.warnings) said += warning.reason + '\n';
    expectHolds(said, "'cloud.obj' has no line of 'f'");
  }
}

TEST(HostileGltf, NestingIsRefusedAndLongChainsOfNodesAreRead) {
  const TempFolder folder;
  expectHolds(complaint(folder.write("a.gltf", std::string(300'000, '['))), "is nested more than");
  expectHolds(complaint(folder.write("a.gltf", repeated("{\"a\":", 300'000))), "is nested more than");
  std::string nodes;
  for (int i = 1; i <= 18'000; ++i) nodes += "{\"children\": [" + std::to_string(i) + "]},";
  std::string text = gltfOf("a.bin");
  folder.write("a.bin", std::string(36, '\0'));
  text.replace(text.find("{\"mesh\": 0}"), 11, nodes + "{\"mesh\": 0}");
  EXPECT_EQ(namesOf(scene::readInput(folder.write("a.gltf", text))), "a.gltf TTriangleModel 1\n");
}

TEST(HostileGltf, NodesThatAreSharedOrGoInCirclesAreRefused) {
  const TempFolder folder;
  std::string nodes;
  for (int i = 1; i < 40; ++i) nodes += "{\"children\": [" + std::to_string(i) + ", " + std::to_string(i) + "]},";
  std::string text = gltfOf("a.bin");
  text.replace(text.find("{\"mesh\": 0}"), 11, nodes + "{}");
  expectHolds(complaint(folder.write("a.gltf", text)), "has more than one parent");
  text = gltfOf("a.bin");
  text.replace(text.find("{\"mesh\": 0}"), 11, "{\"children\": [0]}");
  expectHolds(complaint(folder.write("a.gltf", text)), "node 0 has more than one parent");
}

TEST(HostileGltf, CountsBeyondTheBytesAreRefusedBeforeAnythingIsAllocated) {
  const TempFolder folder;
  folder.write("a.bin", std::string(36, '\0'));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = gltfOf("a.bin");
    text.replace(text.find(from), from.size(), to);
    return complaint(folder.write("a.gltf", text));
  };
  EXPECT_EQ(changed("\"count\": 3", "\"count\": 3"), "");
  expectHolds(changed("\"count\": 3", "\"count\": 4"), "accessor 0 promises 4 entries, its buffer view has 3");
  expectHolds(changed("\"count\": 3", "\"count\": 18446744073709551615"), "truncated: accessor 0 promises");
  expectHolds(changed("\"byteLength\": 36}]", "\"byteLength\": 37}]"), "truncated: bufferView 0 promises 37 bytes");
  expectHolds(changed("\"bufferView\": 0, \"componentType\": 5126, \"count\": 3",
                      "\"componentType\": 5126, \"count\": 70000000"),
              "takes more than");
  expectHolds(changed("\"count\": 3", "\"count\": -3"), "'count' is no count");
  expectHolds(changed("\"count\": 3", "\"count\": 2"), "mesh 0 has 2 corners, no whole number of triangles");
  expectHolds(changed(R"("POSITION": 0}})", R"("POSITION": 0}, "mode": 1})"),
              "has 3 corners, no whole number of lines");
  const auto placed = [&](const std::string& transform) {
    return changed(R"({"mesh": 0})", R"({"mesh": 0, )" + transform + '}');
  };
  EXPECT_EQ(placed(R"("rotation": [0, 0.70710678, 0, 0.7071])"), "");
  expectHolds(placed(R"("rotation": [0, 0, 0, 2])"), "node 0 has a rotation that is no quaternion of length 1");
  expectHolds(placed(R"("rotation": [0, 0, 0, 0])"), "node 0 has a rotation that is no quaternion of length 1");
  EXPECT_EQ(placed(R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 4,5,6,1])"), "");
  for (const std::string matrix : {"1,0,0,0.1, 0,1,0,0, 0,0,1,0, 4,5,6,1", "1,0,0,0, 0,1,0,0, 0,0,1,0, 4,5,6,2"}) {
    expectHolds(placed(R"("matrix": [)" + matrix + ']'), "node 0 has a matrix whose last row is not 0 0 0 1");
  }
}

TEST(GltfMesh, SparseAndQuantizedAccessorsStripsFansAndMatricesAreRead) {
  const TempFolder folder;
  // Four corners as normalized int8 with a stride of 4, then as sparse: index 3 and its position.
  folder.write("a.bin", std::string("\0\0\0\0\x7f\0\0\0\0\x7f\0\0\x7f\x7f\0\0\x03\0\0\0\0\0\x7f\0", 24));
  const std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0, "name": "n", "matrix": [2,0,0,0, 0,2,0,0, 0,0,2,0, 5,6,7,1]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5}, {"attributes": {"POSITION": 1}, "mode": 6},
{"attributes": {"POSITION": 0}, "mode": 2}, {"attributes": {"POSITION": 0}, "mode": 0}]}],
"accessors": [{"bufferView": 0, "componentType": 5120, "normalized": true, "count": 4, "type": "VEC3"},
{"bufferView": 0, "componentType": 5120, "normalized": true, "count": 4, "type": "VEC3", "sparse": {"count": 1,
"indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 2}}}],
"bufferViews": [{"buffer": 0, "byteLength": 16, "byteStride": 4}, {"buffer": 0, "byteOffset": 16, "byteLength": 4},
{"buffer": 0, "byteOffset": 20, "byteLength": 3}], "buffers": [{"byteLength": 24, "uri": "a.bin"}]})";
  const auto scene = scene::readInput(folder.write("a.gltf", text));
  EXPECT_EQ(namesOf(scene), "n TTriangleModel 4\nn#2 TLineModel 4\nn#3 TPointModel 4\n");
  const auto& model = dynamic_cast<const collision::TriangleModel&>(*scene.models[0]);
  using Triangles = std::vector<collision::TriangleModel::Triangle>;
  EXPECT_EQ(model.triangles(), (Triangles{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {4, 6, 7}}));
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{5, 6, 7}, {7, 8, 9}}));
  EXPECT_EQ(boxOf(*scene.models[2]), (Box{{5, 6, 7}, {7, 8, 7}}));
}

TEST(GltfMesh, OfStripsAndFansNothingIsThereThatOnlyLeadsToTheNextPiece) {
  const TempFolder folder;
  folder.write("a.bin", std::string("\0\0\0\0\x7f\0\0\0\0\x7f\0\0\x7f\x7f\0\0\0\1\2\2\3\3\1\0\0\1\1\2\3\0\0\0", 32));
  const std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 5},
{"attributes": {"POSITION": 0}, "indices": 2, "mode": 6}]}],
"accessors": [{"bufferView": 0, "componentType": 5120, "count": 4, "type": "VEC3"},
{"bufferView": 1, "componentType": 5121, "count": 7, "type": "SCALAR"},
{"bufferView": 1, "byteOffset": 8, "componentType": 5121, "count": 5, "type": "SCALAR"}],
"bufferViews": [{"buffer": 0, "byteLength": 16, "byteStride": 4}, {"buffer": 0, "byteOffset": 16, "byteLength": 16}],
"buffers": [{"byteLength": 32, "uri": "a.bin"}]})";
  const auto scene = scene::readInput(folder.write("a.gltf", text));
  const auto& model = dynamic_cast<const collision::TriangleModel&>(*scene.models[0]);
  using Triangles = std::vector<collision::TriangleModel::Triangle>;
  EXPECT_EQ(model.triangles(), (Triangles{{0, 1, 2}, {4, 5, 6}, {4, 6, 7}}));
}

TEST(GltfMesh, ExtensionsThatAreNotReadAreNamed) {
  const TempFolder folder;
  folder.write("a.bin", std::string(36, '\0'));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = gltfOf("a.bin");
    text.replace(text.find(from), from.size(), to);
    const std::string path = folder.write("a.gltf", text);
    const std::string problem = complaint(path);
    return problem.starts_with(path) ? problem.substr(path.size()) : problem;
  };
  const std::string required = R"({"extensionsRequired": ["EXT_a", 1, "KHR_b", "no name", "\u001b[2J"], )";
  const std::string nothing = ": holds no triangles, lines or points";
  EXPECT_EQ(changed(R"("POSITION": 0}}])", R"("POSITION": 0}, "extensions": {"KHR_draco_mesh_compression": {}}}])"),
            ": mesh 0 is compressed by KHR_draco_mesh_compression, which is not read");
  for (const std::string name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    EXPECT_EQ(changed(R"("byteLength": 36}], "buffers")",
                      R"("byteLength": 36, "extensions": {")" + name + R"(": {}}}], "buffers")"),
              ": bufferView 0 is compressed by " + name + ", which is not read");
  }
  EXPECT_EQ(changed(R"({"mesh": 0})", R"({"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}})"),
            ": node 0 has copies by EXT_mesh_gpu_instancing, which is not read");
  EXPECT_EQ(changed(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],)",
                    required + R"("asset": {"version": "2.0"}, "scenes": [{"nodes": []}],)"),
            nothing + " that can be read without EXT_a, KHR_b");
  EXPECT_EQ(changed(R"("scenes": [{"nodes": [0]}])", R"("scenes": [{"nodes": []}])"), nothing);
  EXPECT_EQ(changed("{\"asset\"", required + "\"asset\""), "") << "what is there is read";
}

TEST(HostileAssimp, WhatOverflowsItsStackIsAnError) {
  constexpr std::size_t kDepth = 300'000;
  const TempFolder folder;
  const auto expectRefused = [&](const std::string& name, const std::string& text) {
    EXPECT_NE(complaint(folder.write(name, text)), "") << name;
  };
  expectRefused("a.dae", "<COLLADA version=\"1.4.1\"><library_visual_scenes><visual_scene id=\"s\">" +
                             repeated("<node id=\"n\">", kDepth) + repeated("</node>", kDepth) +
                             "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene>"
                             "</COLLADA>");
  expectRefused("b.dae",
                "<COLLADA version=\"1.4.1\"><library_nodes><node id=\"a\"><instance_node url=\"#a\"/></node>"
                "</library_nodes><library_visual_scenes><visual_scene id=\"s\"><node><instance_node url=\"#a\"/></node>"
                "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
  expectRefused("a.x3d", "<X3D version=\"3.0\"><Scene>" + repeated("<Group>", kDepth) + repeated("</Group>", kDepth) +
                             "</Scene></X3D>");
  expectRefused("a.x", "xof 0303txt 0032\n" + repeated("Frame A {\n", kDepth) + repeated("}\n", kDepth));
  expectRefused("a.ogex", repeated("Node {\n", kDepth) + repeated("}\n", kDepth));
  expectRefused("a.bvh", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n" +
                             repeated("JOINT b\n{\nOFFSET 0 0 0\nCHANNELS 0\n", kDepth) + repeated("}\n", kDepth));
}

TEST(ReadMemory, WhatASceneDescribesInAFewBytesIsBounded) {
  const TempFolder folder;
  for (const std::string& bomb : {std::string("<MeshTopology position='0 0 0' triangles='0 1 100000000'/>"),
                                  std::string("<RegularGridTopology n='2000 100 100'/>"),
                                  std::string("<MeshTopology position='0 0 0' triangles='0 1 3999999999'/>"),
                                  std::string("<RegularGridTopology n='100000 100000 100000'/>")}) {
    const std::string said = complaint(folder.write("a.scn", sceneOf(bomb)));
    expectHolds(said, "a.scn:2: ");
    EXPECT_TRUE(said.find("takes more than 256 MiB") != std::string::npos ||
                said.find("a grid of") != std::string::npos)
        << said;
  }
  EXPECT_EQ(complaint(folder.write("a.scn", sceneOf("<RegularGridTopology n='40 40 40'/>"))), "");
}

TEST(ReadMemory, RangesOfIndicesAreBounded) {
  const TempFolder folder;
  const auto read = [&](const std::string& range) {
    return complaint(
        folder.write("a.scn", sceneOf("<MeshTopology position='0 0 0 1 0 0 0 1 0' triangles='0 1 2'/><Node>"
                                      "<MechanicalObject position='0 0 0 1 0 0 0 1 0'/><Node><MechanicalObject/>"
                                      "<SubsetMapping indices='" +
                                      range + "'/><PointModel/></Node></Node>")));
  };
  EXPECT_EQ(read("0-2"), "");
  for (const std::string& range : {std::string("0-49000000"), std::string("1e300-1e300"), repeated("0-4000000 ", 10)}) {
    expectHolds(read(range), "is neither an index nor a range of few enough to be read");
  }
}

TEST(ReadMemory, IsWhatTheCallerAllows) {
  const TempFolder folder;
  const fs::path mesh = folder.write("a.obj", kObj);
  EXPECT_EQ(complaint(mesh), "");
  expectHolds(complaint(mesh, {.maxMemory = 1000}),
              "takes more than 1000 bytes of memory to read, which is what --max-memory");
  const std::string points = repeated("1 2 3 ", 20'000);
  const fs::path inElement =
      folder.write("b.scn", sceneOf("<MechanicalObject><Attribute type='position'><Data value='" + points +
                                    "'/></Attribute></MechanicalObject>"));
  expectHolds(complaint(inElement, {.maxMemory = 300'000}), "which is what --max-memory");
  const std::string size = kIsSanitized ? "56 56 56" : "80 80 80";
  const fs::path grid = folder.write("a.scn", sceneOf("<RegularGridTopology n='" + size + "'/>"));
  expectHolds(complaint(grid), "--max-memory allows more");
  EXPECT_EQ(complaint(grid, {.maxMemory = 4ULL << 30}), "");
}

TEST(ErrorMessages, AreOneShortLineWhateverIsInTheFile) {
  const TempFolder folder;
  const std::string longWord = repeated("x\x1b[31m", 139'000 / 6);
  const std::string newLine = "a&#10;b";
  for (const fs::path& path :
       {folder.write("a.obj", "v 0 0 0\nf 1 1 " + longWord + "\n"),
        folder.write("a.csv", longWord + ",1,2,3,4,5\n1,2\n"),
        folder.write("a.ply", "ply\nformat " + longWord + " 1.0\n"),
        folder.write("a.scn", "<Node><include href='" + newLine + longWord + "'/></Node>"),
        folder.write("b.scn", "<Node name='" + newLine + longWord + "'><TriangleModel/></Node>")}) {
    const std::string said = complaint(path);
    expectHolds(said, path.string());
    EXPECT_LE(said.size(), 500U);
    EXPECT_EQ(said.find_first_of("\n\r\x1b"), std::string::npos) << said;
  }
}

TEST(ErrorMessages, KeepTheirBeginningAndTheirEndAndWholeCharacters) {
  EXPECT_EQ(Error("a\tb\n").what(), std::string("a\\x09b\\x0a"));
  EXPECT_EQ(Error(std::string(500, 'a')).what(), std::string(500, 'a'));
  const std::string said = Error("begin" + repeated("\xc3\xa4", 400'000) + "end").what();
  EXPECT_LE(said.size(), 500U);
  EXPECT_TRUE(said.starts_with("begin\xc3\xa4") && said.ends_with("\xc3\xa4"
                                                                  "end"))
      << said;
  const std::size_t dots = said.find("...");
  ASSERT_NE(dots, std::string::npos);
  EXPECT_EQ(said.substr(dots - 2, 7), "\xc3\xa4...\xc3\xa4");
}

}  // namespace
}  // namespace allpairs::test
