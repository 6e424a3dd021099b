// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "Expect.h"
#include "SceneText.h"
#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

constexpr const char* kTwoParts = R"(# two objects that share vertices, and names with blanks
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 0.1
o part one
f 1 2 3
o part two
f 1/1 2/2/2 4//3
f -4 -3 -2 -1
o part one
l 1 2 3
p 1 4
)";

constexpr const char* kStl = R"(solid two words
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid two words
)";

// Two nodes that show one mesh, the second moved and under a parent that is scaled, a third without a name.
constexpr const char* kGltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 3]}],
"nodes": [{"name": "wheel", "mesh": 0}, {"name": "axle", "scale": [2, 2, 2], "children": [2]},
{"name": "wheel", "mesh": 0, "translation": [5, 0, 0]}, {"mesh": 0}],
"meshes": [{"name": "disc", "primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

scene::Scene read(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  return scene::readInput(folder.write(name, bytes));
}

void expectProblem(const std::string& name, const std::string& bytes, const std::string& part) {
  expectFileError([&] { (void)read(name, bytes); }, part);
}

/// However a file is cut, it is read or refused with a FileError.
void expectCutsAreHandled(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto path = folder.write(name, std::string_view(bytes).substr(0, length));
    try {
      EXPECT_FALSE(scene::readInput(path).models.empty());
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
  }
}

TEST(ObjMesh, EachObjectIsABodyWithItsNameExactlyAsInTheFile) {
  const scene::Scene scene = read("parts.obj", kTwoParts);
  EXPECT_EQ(
      namesOf(scene),
      "part one TTriangleModel 1\npart two TTriangleModel 3\npart one#2 TLineModel 2\npart one#3 TPointModel 2\n");
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(boxOf(*scene.models[3]), (Box{{0, 0, 0}, {0, 0, 0.1}})) << "0.1 is read in double";
  std::set<const void*> owners;
  for (const auto& model : scene.models) owners.insert(model->getOwner());
  EXPECT_EQ(owners.size(), 3U) << "lines and points of one object are of one owner, objects of different ones";
  EXPECT_EQ(owners.count(nullptr), 0U);
}

TEST(ObjMesh, GroupsAreObjectsWhereThereIsNoObject) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(namesOf(read("g.obj", vertices + "g a b\nf 1 2 3\ng c\nf 1 2 3\ng a b\nf 1 2 3\n")),
            "a b TTriangleModel 2\nc TTriangleModel 1\n");
  EXPECT_EQ(namesOf(read("g.obj", vertices + "g a\nf 1 2 3\no x\ng b\nf 1 2 3\n")),
            "g.obj TTriangleModel 1\nx TTriangleModel 1\n");
}

TEST(ObjMesh, VerticesKeepTheirOrderAndTheirNumbersWhereThereIsOneObject) {
  using Triangles = std::vector<collision::TriangleModel::Triangle>;
  const auto trianglesOf = [](const scene::Scene& scene, std::size_t model) {
    return dynamic_cast<const collision::TriangleModel&>(*scene.models.at(model)).triangles();
  };
  const std::string vertices = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(trianglesOf(read("one.obj", vertices + "f 4 2 3\n"), 0), (Triangles{{3, 1, 2}}));
  const scene::Scene two = read("two.obj", vertices + "o a\nf 4 2 3\no b\nf 1 4 3\n");
  EXPECT_EQ(trianglesOf(two, 0), (Triangles{{2, 0, 1}}));
  EXPECT_EQ(trianglesOf(two, 1), (Triangles{{0, 2, 1}}));
}

TEST(ObjMesh, NothingButVerticesIsACloudOfPoints) {
  EXPECT_EQ(namesOf(read("cloud.obj", "v 0 0 0\nv 1 0 0\n")), "cloud.obj TPointModel 2\n");
}

TEST(ObjMesh, ALineMayGoOnInTheNext) {
  EXPECT_EQ(namesOf(read("long.obj", "v 0 0 0\nv 1 0 0\nv 0 1 \\\n 0\nf 1 2 \\\r\n 3\n")),
            "long.obj TTriangleModel 1\n");
}

TEST(ObjMesh, ACommentDoesNotGoOnInTheNextLine) {
  const scene::Scene scene = read("a.obj", "# C:\\temp\\\nv 5 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 4\n");
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {5, 1, 0}}));
}

TEST(ObjMesh, CommentsMayFollowWhatAShapeIsMadeOf) {
  const scene::Scene scene =
      read("a.obj",
           "v 0 0 0#one\nv 1 0 0 # C:\\temp\\\nv 0 1 0 # three\nv 0 2 0\no # 1\nf 1 2 3 # a face\n"
           "f 1 \\\n# the others\n2 \\\n4 # 3\nl 1 2#3\np 4 # \\\np 3 \\\n# the end");
  EXPECT_EQ(namesOf(scene), "# 1 TTriangleModel 2\n# 1#2 TLineModel 1\n# 1#3 TPointModel 2\n");
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {1, 2, 0}}));
  expectProblem("a.obj", "v 0 0 # 0\n", "a.obj:1: a position has three coordinates");
  expectProblem("a.obj", "v 0 0 0\nf # 1 1 1\n", "a.obj:2: an element has no vertices");
}

TEST(MeshText, InUtf16IsNamed) {
  for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.off", "a.dxf"}) {
    std::string little = "\xff\xfe";
    std::string big = "\xfe\xff";
    for (const char c : std::string(kStl)) {
      little += {c, '\0'};
      big += {'\0', c};
    }
    expectProblem(name, little, name + ": is a text in UTF-16; UTF-8 can be read");
    expectProblem(name, big, name + ": is a text in UTF-16; UTF-8 can be read");
  }
}

TEST(ObjMesh, MayBeginWithAMarkAndHaveTheLinesOfOldMacs) {
  const std::string text = "v 9 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n";
  std::string mac = text;
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  for (const std::string& bytes : {"\xEF\xBB\xBF" + text, mac, "\xEF\xBB\xBF" + mac, mac + "# one of another\n",
                                   std::string("v 9 0 0\r\r\nv 0 0 0\r\nv 0 1 0\rf 1 2 3")}) {
    const scene::Scene scene = read("a.obj", bytes);
    EXPECT_EQ(namesOf(scene), "a.obj TTriangleModel 1\n");
    EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {9, 1, 0}}));
  }
}

TEST(ObjMesh, ErrorsNameTheLine) {
  expectProblem("a.obj", "v 0 0\n", "a.obj:1: a position has three coordinates");
  expectProblem("a.obj", "v 0 0 0\nv 0 nan 0\n", "a.obj:2: 'nan' is no finite number");
  expectProblem("a.obj", "v 0 0 0\nf 1 1 2\n", "a.obj:2: index 2 names no vertex: the file has 1");
  expectProblem("a.obj", "v 0 0 0\nf 1 1 0\n", "a.obj:2: index 0");
  expectProblem("a.obj", "v 0 0 0\nf 1 1 -2\n", "a.obj:2: index -2");
  expectProblem("a.obj", "v 0 0 0\nf 1 1 x\n", "a.obj:2: 'x' is no index");
  expectProblem("a.obj", "v 0 0 0\nf 99999999999999999999 1 1\n", "a.obj:2:");
  expectProblem("a.obj", "# nothing\n", "holds no triangles, lines or points");
  expectProblem("a.obj", "v 0 0 0\nsurf 0 1 0 1 1\n", "a.obj:2: 'surf' is not read");
  expectProblem("a.obj", "v 0 0 0\ncall other.obj\n", "a.obj:2: 'call' is not read");
  expectProblem("a.obj", "v 0 0 0\r\r\nv 0 nan 0\r\r\n", "a.obj:2: 'nan' is no finite number");
  expectProblem("a.obj", "v 0 0 0\nfo 1 1 1\n", "a.obj:2: 'fo' is not read");
}

TEST(GltfMesh, EachNodeThatShowsAMeshIsABodyInItsPlace) {
  const scene::Scene scene = read("car.gltf", kGltf);
  EXPECT_EQ(namesOf(scene), "wheel TTriangleModel 1\naxle/wheel TTriangleModel 1\ndisc TTriangleModel 1\n");
  EXPECT_EQ(boxOf(*scene.models[1]), (Box{{10, 0, 0}, {12, 2, 0}}));
}

TEST(Mesh, FilesCutAnywhereAreReadOrRefused) {
  expectCutsAreHandled("cut.obj", kTwoParts);
  expectCutsAreHandled("cut.gltf", kGltf);
  std::string skinned = kGltf;
  skinned.replace(skinned.find("\"wheel\", \"mesh\""), 15, "\"wheel\", \"skin\": 0, \"mesh\"");
  skinned.replace(skinned.find("\"name\": \"disc\""), 14, "\"weights\": [0, 0.5], \"name\": \"disc\"");
  const scene::Scene remarked = read("car.gltf", skinned);
  ASSERT_EQ(remarked.remarks.size(), 3U) << "each node that shows a mesh";
  EXPECT_EQ(remarked.remarks[0].subject, "wheel");
  EXPECT_EQ(remarked.remarks[0].reason, "its skin is passed over: the vertices are where they are without it");
  EXPECT_EQ(remarked.remarks[1].reason,
            "its morph targets are passed over: the vertices are where they are without them");
  EXPECT_TRUE(read("car.gltf", kGltf).remarks.empty());
  std::string more = kGltf;
  more.replace(more.find("\"scenes\": ["), 11, "\"animations\": [{}], \"scenes\": [{}, ");
  more.replace(more.find("\"scene\": 0"), 10, "\"scene\": 1");
  const scene::Scene animated = read("car.gltf", more);
  ASSERT_EQ(animated.remarks.size(), 2U);
  EXPECT_EQ(animated.remarks[0].subject, "car.gltf");
  EXPECT_EQ(animated.remarks[0].reason, "its animations are passed over: nodes are where they are without them");
  EXPECT_EQ(animated.remarks[1].reason, "1 of its 2 scenes is passed over: only the one to be shown is read");
  std::string odd = kGltf;
  odd.replace(odd.find("\"count\": 3"), 10, "\"count\": 3, \"normalized\": 0");
  expectProblem("odd.gltf", odd, "odd.gltf: accessor 0: 'normalized' is neither true nor false");
}

TEST(Mesh, ScenesThatAreProgramsAreRefusedWithWhatToDo) {
  for (const auto* name : {"scene.py", "scene.pyscn"})
    expectProblem(name, "", "is a SOFA scene in Python, which only SOFA can run: open it in runSofa, save it as .scn");
  for (const auto* name : {"scene.pscn", "scene.php"})
    expectProblem(name, "", "is a SOFA scene in PHP, which is a program: read what it prints, `php -f");
}

TEST(Mesh, AnUnknownKindOfFileIsRefused) { expectProblem("notes.txt", "hello", "is of no kind that is known"); }

TEST(MeshFolder, ReadsMeshesByNameAndRemarksOnTheRest) {
  const TempFolder folder;
  folder.write("b.stl", kStl);
  folder.write("a.obj", kTwoParts);
  folder.write("c.stl", kStl);
  folder.write("readme.txt", "hello");
  std::filesystem::create_directory(folder.path() / "more");
  const scene::Scene scene = scene::readInput(folder.path());
  EXPECT_EQ(namesOf(scene),
            "part one TTriangleModel 1\npart two TTriangleModel 3\npart one#2 TLineModel 2\npart one#3 TPointModel 2\n"
            "b.stl › two words TTriangleModel 1\nc.stl › two words TTriangleModel 1\n");
  ASSERT_EQ(scene.remarks.size(), 2U);
  EXPECT_EQ(scene.remarks[0].subject, "more");
  EXPECT_EQ(scene.remarks[1].subject, "readme.txt");
}

TEST(MeshFolder, WithoutMeshesIsAnError) {
  const TempFolder folder;
  folder.write("readme.txt", "hello");
  expectFileError([&] { (void)scene::readInput(folder.path()); }, "is a folder without mesh files");
}

TEST(Mesh, FoldersWithinAFolderAndCadFilesAreNamedWhereThereIsNothingElse) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "wheels");
  expectFileError(
      [&] { (void)scene::readInput(folder.path()); },
      "is a folder without mesh files; --recursive of detect, info, view and report searches those within it, too");
  const auto cad = folder.write("gear.STEP", "ISO-10303-21;");
  expectFileError([&] { (void)scene::readInput(cad); }, "has the exact surfaces of a CAD program, which are not read");
  for (const char* name : {"a.prt", "a.SAT", "a.jt", "a.3dm", "a.f3d", "a.FCStd"})
    expectFileError([path = folder.write(name, "x")] { (void)scene::readInput(path); }, "has the exact surfaces of a");
  for (const char* name : {"a.vtk", "a.VTU", "a.msh"})
    expectFileError([path = folder.write(name, "x")] { (void)scene::readInput(path); },
                    "is of a format that is read only where a scene names it: export another mesh");
  for (const char* name : {"a.usdz", "a.wrl", "a.skp"})
    expectFileError([path = folder.write(name, "x")] { (void)scene::readInput(path); },
                    "is of a format that is not read: export a mesh");
}

TEST(MeshFolder, NothingStaysOfAFileThatIsLeftOutMidway) {
  const TempFolder folder;
  std::string many;
  for (int i = 1; i <= 3000; ++i) {
    const std::string first = std::to_string(3 * i - 2);
    many += "o part\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf " + first + ' ' + std::to_string(3 * i - 1) + ' ' +
            std::to_string(3 * i) + '\n';
  }
  folder.write("b.obj", many);
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const scene::Scene scene = scene::readInput(folder.path(), {.partial = true, .maxMemory = 3 << 20});
  EXPECT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.owners.size(), 1U);
  EXPECT_EQ(scene.sources.size(), 1U);
  EXPECT_EQ(scene.files.size(), 1U);
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_EQ(scene.remarks.front().subject, "b.obj");
  EXPECT_TRUE(scene.remarks.front().isPartial);
}

TEST(MeshFolder, OfCadFilesAloneHasNoHintThatWouldLeaveNothing) {
  const TempFolder folder;
  folder.write("gear.STEP", "ISO-10303-21;");
  try {
    (void)scene::readInput(folder.path());
    ADD_FAILURE() << "it was read";
  } catch (const FileError& error) {
    EXPECT_EQ(error.problem().find("--partial"), std::string::npos) << error.what();
  }
}

TEST(MeshFolder, ACadFileIsAnErrorUnlessPartialOrThereAsAMeshToo) {
  const TempFolder folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("cube.obj", mesh);
  folder.write("gear.STEP", "ISO-10303-21;");
  expectFileError([&] { (void)scene::readInput(folder.path()); },
                  "; --partial of detect, info, view and report leaves it out");
  const scene::Scene partial = scene::readInput(folder.path(), {.partial = true});
  EXPECT_EQ(partial.models.size(), 1U);
  ASSERT_EQ(partial.remarks.size(), 1U);
  EXPECT_TRUE(partial.remarks[0].isPartial);
  EXPECT_EQ(textOf(partial.remarks[0]).find((folder.path() / "gear.STEP").string() + ": has the exact surfaces"), 0U);
  std::filesystem::create_directory(folder.path() / "gear.stl");  // is no mesh
  expectFileError([&] { (void)scene::readInput(folder.path()); },
                  "; --partial of detect, info, view and report leaves it out");
  std::filesystem::remove(folder.path() / "gear.stl");
  folder.write("gear.obj", mesh);
  const scene::Scene whole = scene::readInput(folder.path());
  EXPECT_EQ(whole.models.size(), 2U);
  ASSERT_EQ(whole.remarks.size(), 1U);
  EXPECT_FALSE(whole.remarks[0].isPartial);
}

TEST(MeshFolder, AMeshOfAFormatThatIsNotReadIsAnErrorUnlessPartial) {
  for (const char* name : {"skin.vtk", "skin.usdz"}) {
    const TempFolder folder;
    folder.write("cube.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write(name, "x");
    expectFileError([&] { (void)scene::readInput(folder.path()); },
                    "; --partial of detect, info, view and report leaves it out");
    const scene::Scene partial = scene::readInput(folder.path(), {.partial = true});
    ASSERT_EQ(partial.remarks.size(), 1U);
    EXPECT_TRUE(partial.remarks[0].isPartial);
  }
}

TEST(MeshFolder, OfWhichAllIsLeftOutTellsWhatAndWhy) {
  const TempFolder folder;
  folder.write("gear.STEP", "ISO-10303-21;");
  folder.write("readme.txt", "hello");
  const scene::Scene scene = scene::readInput(folder.path(), {.partial = true});
  EXPECT_TRUE(scene.models.empty());
  ASSERT_EQ(scene.remarks.size(), 2U);
  EXPECT_FALSE(scene.remarks[0].isPartial);
  EXPECT_TRUE(scene.remarks[1].isPartial);
  EXPECT_EQ(textOf(scene.remarks[1]).find((folder.path() / "gear.STEP").string() + ": has the exact surfaces"), 0U);
  std::filesystem::remove(folder.path() / "gear.STEP");
  expectFileError([&] { (void)scene::readInput(folder.path(), {.partial = true}); }, "is a folder without mesh files");
}

TEST(MeshFolder, WhatMacOsKeepsBesideAFileIsNoMesh) {
  const TempFolder folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("cube.obj", mesh);
  folder.write("._cube.obj", std::string("\0\5\x16\7\0\2\0\0Mac OS X", 16));
  folder.write("._gear.step", std::string("\0\5\x16\7", 4));
  const scene::Scene scene = scene::readInput(folder.path());
  EXPECT_EQ(scene.models.size(), 1U);
  ASSERT_EQ(scene.remarks.size(), 2U);
  EXPECT_EQ(scene.remarks[0].subject, "._cube.obj");
  EXPECT_FALSE(scene.remarks[0].isPartial);
  // Links are not followed to see what they are, and the name alone leaves nothing out.
  std::filesystem::create_symlink(folder.path() / "._cube.obj", folder.path() / "._link.obj");
  expectFileError([&] { (void)scene::readInput(folder.path()); }, "holds no triangles, lines or points");
  std::filesystem::remove(folder.path() / "._link.obj");
  folder.write("._cube.obj", mesh);
  EXPECT_EQ(scene::readInput(folder.path()).models.size(), 2U);
  folder.write("._cube.obj", std::string("\0\5", 2));
  expectFileError([&] { (void)scene::readInput(folder.path()); }, "holds no triangles, lines or points");
}

TEST(MeshFolder, IsReadWithTheFoldersWithinItOnlyWhereThatIsAskedFor) {
  const TempFolder folder;
  for (const char* part : {"left/door", "right/door", "right/empty"}) {
    std::filesystem::create_directories(folder.path() / part);
  }
  folder.write("left/door/handle.stl", kStl);
  folder.write("right/door/handle.stl", kStl);
  folder.write("roof.stl", kStl);
  std::filesystem::create_directory_symlink(folder.path(), folder.path() / "right" / "whole");
  const scene::Scene all = scene::readInput(folder.path(), {.recursive = true});
  EXPECT_EQ(namesOf(all),
            "left/door/handle.stl › two words TTriangleModel 1\nright/door/handle.stl › two words TTriangleModel 1\n"
            "roof.stl › two words TTriangleModel 1\n");
  ASSERT_EQ(all.remarks.size(), 1U);
  EXPECT_EQ(all.remarks[0].subject, "whole");
  EXPECT_EQ(all.remarks[0].reason, "is a link to a folder, which is not followed");
  const scene::Scene top = scene::readInput(folder.path());
  EXPECT_EQ(top.models.size(), 1U);
  EXPECT_EQ(top.remarks.size(), 2U);
  expectFileError([&] { (void)scene::readInput(folder.path() / "right" / "empty", {.recursive = true}); },
                  "empty: is a folder without mesh files");
}

TEST(MeshFolder, AFolderWithinItThatCannotBeListedIsAnErrorUnlessPartial) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may list all folders";
  const TempFolder folder;
  folder.write("roof.stl", kStl);
  std::filesystem::create_directory(folder.path() / "locked");
  std::filesystem::permissions(folder.path() / "locked", std::filesystem::perms::none);
  expectFileError([&] { (void)scene::readInput(folder.path(), {.recursive = true}); }, "locked: cannot be listed");
  const scene::Scene scene = scene::readInput(folder.path(), {.partial = true, .recursive = true});
  EXPECT_EQ(scene.models.size(), 1U);
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_TRUE(scene.remarks[0].isPartial);
  std::filesystem::permissions(folder.path() / "locked", std::filesystem::perms::owner_all);
}

TEST(MeshFolder, WhatCannotBeLookedAtIsAnErrorUnlessPartial) {
  const TempFolder folder;
  folder.write("roof.stl", kStl);
  const std::string level(250, 'd');
  int descriptor = ::open(folder.path().c_str(), O_RDONLY);
  for (int i = 0; i < 17; ++i) {  // longer than a path may be
    ASSERT_EQ(::mkdirat(descriptor, level.c_str(), 0700), 0);
    const int next = ::openat(descriptor, level.c_str(), O_RDONLY);
    ::close(std::exchange(descriptor, next));
  }
  ::close(descriptor);
  expectFileError([&] { (void)scene::readInput(folder.path(), {.recursive = true}); },
                  "cannot be looked at: File name");
  const scene::Scene scene = scene::readInput(folder.path(), {.partial = true, .recursive = true});
  EXPECT_EQ(scene.models.size(), 1U);
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_TRUE(scene.remarks[0].isPartial);
}

TEST(Mesh, WhatGitLfsHasInPlaceOfAFileIsCalledThat) {
  const TempFolder folder;
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a2146\nsize 12345\n";
  for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.glb", "a.dae", "a.npy", "a.csv", "a.scn"})
    expectFileError([path = folder.write(name, pointer)] { (void)scene::readInput(path); },
                    name + ": is a Git LFS pointer, not the file: 'git lfs pull' in its folder gets it");
}

TEST(Mesh, AFileWithoutAByteIsSaidToBeEmpty) {
  const TempFolder folder;
  for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.off", "a.gltf", "a.glb", "a.dae", "a.3mf"})
    expectFileError([path = folder.write(name, "")] { (void)scene::readInput(path); }, name + ": is empty");
}

TEST(MeshFolder, AMeshThatCannotBeReadIsAnErrorUnlessPartial) {
  const TempFolder folder;
  folder.write("a.obj", kTwoParts);
  folder.write("bad.obj", "v 0 0\n");
  expectFileError([&] { (void)scene::readInput(folder.path()); }, "bad.obj:1:");
  const scene::Scene scene = scene::readInput(folder.path(), {.searchRoots = {}, .partial = true, .progress = {}});
  EXPECT_EQ(scene.models.size(), 4U);
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_EQ(scene.remarks[0].subject, "bad.obj");
}

TEST(Mesh, AStopEndsReadingOfWhateverKind) {
  const TempFolder folder;
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string scene = "<Node><MechanicalObject position='0 0 0'/><PointCollisionModel/></Node>";
  const std::string collada = "<COLLADA></COLLADA>";
  for (const auto& path : {folder.write("boxes.csv", "0,0,0,1,1,1\n"), folder.write("mesh.obj", mesh),
                           folder.write("scene.scn", scene), folder.write("mesh.dae", collada)}) {
    StopFlag stop;
    stop.set();
    scene::ReadOptions options;
    options.stop = &stop;
    EXPECT_THROW(static_cast<void>(scene::readInput(path, options)), Stopped) << path;
  }
}

}  // namespace
}  // namespace allpairs::test
