// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Data.h"
#include "support/Npy.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// A triangle in the plane z = 0, and one above it that falls through it by the end of the step.
constexpr const char* kStart = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 2\nv 2 1 2\nv 1 2 2\nf 1 2 3\nf 4 5 6\n";
constexpr const char* kEnd = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 2 1 -1\nv 1 2 -1\nf 1 2 3\nf 4 5 6\n";

nlohmann::json jsonOf(const std::vector<std::string>& arguments) {
  const ProgramRun run = runProgram(arguments);
  expectSuccess(run);
  return nlohmann::json::parse(run.out, nullptr, false);
}

TEST(Elements, ReportsHowManyCandidatesThereAre) {
  const TempFolder folder;
  const std::string start = folder.write("start.obj", kStart);
  const std::string end = folder.write("end.obj", kEnd);
  const nlohmann::json json = jsonOf({"elements", start, end, "--format", "json"});
  EXPECT_EQ(json["vertex_face"], 3);
  EXPECT_EQ(json["edge_edge"], 3);  // those that fall pass the box of the long edge alone
  EXPECT_EQ(json["face_face"], 1);
  EXPECT_EQ(json["edges"], 6);
  const nlohmann::json still = jsonOf({"elements", start, start, "--format", "json"});
  EXPECT_EQ(still["vertex_face"], 0);
  EXPECT_EQ(jsonOf({"elements", start, start, "--distance", "2", "--format", "json"})["face_face"], 1);
}

TEST(Elements, WritesTheCandidatesBesideTheReport) {
  const TempFolder folder;
  const std::string start = folder.write("start.obj", kStart);
  const std::string end = folder.write("end.obj", kEnd);
  expectSuccess(runProgram({"elements", start, end, "-o", folder.path() / "step.json"}));
  const auto pairs = [&](const char* key) {
    return pairsOfNpy(readBytes(folder.path() / (std::string("step.") + key + ".npy")));
  };
  EXPECT_EQ(pairs("vertex_face"), (std::vector<Pair>{{3, 0}, {4, 0}, {5, 0}}));
  EXPECT_EQ(pairs("face_face"), (std::vector<Pair>{{0, 1}}));
  EXPECT_EQ(pairs("edges"), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}, {3, 4}, {3, 5}, {4, 5}}));
  EXPECT_EQ(pairs("edge_edge"), (std::vector<Pair>{{2, 3}, {2, 4}, {2, 5}}));
  EXPECT_NE(readBytes(folder.path() / "step.faces.npy").find("'shape': (2, 3)"), std::string::npos);
  const auto json = nlohmann::json::parse(readBytes(folder.path() / "step.json"), nullptr, false);
  EXPECT_EQ(json["files"]["edge_edge"], (folder.path() / "step.edge_edge.npy").string());
}

TEST(Elements, ToAPipeOrADeviceWriteNoFilesBesideIt) {
  const TempFolder folder;
  const std::string mesh = folder.write("mesh.obj", kStart);
  const ProgramRun run =
      runProgram({"elements", mesh, mesh, "--distance", "inf", "--format", "json", "-o", "/dev/stdout"});
  expectSuccess(run);
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_EQ(json["statistics"]["distance"], "inf");
  EXPECT_EQ(json["face_face"], 1);
  EXPECT_TRUE(json["files"].empty()) << run.out;
  EXPECT_FALSE(std::filesystem::exists("/dev/stdout.edges.npy"));
}

TEST(Elements, MeshesInAnotherOrderAreNotTheSame) {
  const TempFolder folder;
  const std::string points = "v 0 0 0\nv 4 0 0\nv 0 4 0\n";
  const std::string one = folder.write("one.obj", points + "o left\nf 1 2 3\no right\nf 1 2 3\n");
  const std::string other = folder.write("other.obj", points + "o right\nf 1 2 3\no left\nf 1 2 3\n");
  expectFailure(runProgram({"elements", one, other}), 3,
                "other.obj: mesh 0 is 'right' where in '" + one + "' it is 'left'");
  const std::string single = folder.write("single.obj", points + "o now\nf 1 2 3\n");
  expectSuccess(runProgram({"elements", single, folder.write("then.obj", points + "o then\nf 1 2 3\n")}));
}

TEST(Elements, NoListTakesThePlaceOfAnInput) {
  const TempFolder folder;
  const std::string mesh = folder.write("mesh.obj", kStart);
  std::filesystem::create_symlink("mesh.obj", folder.path() / "out.faces.npy");
  expectFailure(runProgram({"elements", mesh, mesh, "-o", folder.path() / "out.json"}), 3, "is an input");
  EXPECT_EQ(readBytes(mesh), kStart);
}

TEST(Elements, OfSeveralMeshesMayBeBetweenThemOnly) {
  const TempFolder folder;
  const std::string start = folder.write("start.obj", kStart);
  const std::string end = folder.write("end.obj", kEnd);
  const std::string wall = folder.write("wall.obj", "v 0 0 0.5\nv 9 0 0.5\nv 0 9 0.5\nf 1 2 3\n");
  const nlohmann::json json = jsonOf({"elements", start, end, wall, wall, "--between", "--format", "json"});
  EXPECT_EQ(json["face_face"], 1);
  EXPECT_EQ(json["vertex_face"], 3);
  EXPECT_EQ(json["meshes"].size(), 2U);
  EXPECT_EQ(runProgram({"elements", start, end, "--between"}).err,
            "allpairs: warning: --between: there is one mesh, which has no other\n");
}

TEST(Elements, OfFramesThatDoNotFitNameTheFileAndTheElement) {
  const TempFolder folder;
  const std::string start = folder.write("start.obj", kStart);
  const std::string fewer = folder.write("fewer.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n");
  const std::string other =
      folder.write("other.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 2\nv 2 1 2\nv 1 2 2\nf 1 2 3\nf 4 6 5\n");
  expectFailure(runProgram({"elements", start, fewer}), 3, "fewer.obj: mesh 'fewer.obj' has 3 vertices where");
  expectFailure(runProgram({"elements", start, other}), 3, "other.obj: triangle 1 of mesh 'other.obj' joins vertices");
  const std::string past = folder.write("past.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 4\n");
  expectFailure(runProgram({"elements", past, past}), 3, "past.obj:4");
  const std::string nan = folder.write("nan.obj", "v 0 0 0\nv 4 nan 0\nv 0 4 0\nf 1 2 3\n");
  expectFailure(runProgram({"elements", nan, nan}), 3, "nan.obj:2");
  const std::string line = folder.write("line.obj", "v 0 0 0\nv 4 0 0\nl 1 2\n");
  expectFailure(runProgram({"elements", line, line}), 3, "line.obj: holds no triangles");
}

TEST(Elements, WithoutAnEndOrUnderANameOfAnotherFormatIsWrongUsage) {
  const TempFolder folder;
  const std::string start = folder.write("start.obj", kStart);
  expectFailure(runProgram({"elements", start}), 2, "has no END");
  expectFailure(runProgram({"elements", start, start, "-o", folder.path() / "x.npy"}), 2, "x.npy");
  expectFailure(runProgram({"elements", start, start, "--distance", "far"}), 2, "'far'");
  expectFailure(runProgram({"elements", "missing", "missing", "-o", folder.path() / "x.dat"}), 2, "x.dat");
}

/// A step of the data, and how many candidates it is known to have.
struct KnownStep {
  const char* start;
  const char* end;
  std::uint64_t vertexFace;
  std::uint64_t edgeEdge;
  std::uint64_t faceFace;

  friend std::ostream& operator<<(std::ostream& out, const KnownStep& step) { return out << step.start; }
};

class ElementsOfData : public testing::TestWithParam<KnownStep> {};

TEST_P(ElementsOfData, AreAsManyAsArePublished) {
  const std::filesystem::path folder = dataFolder() / "ccd";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no data folder";
  const KnownStep& step = GetParam();
  const nlohmann::json json = jsonOf({"elements", folder / step.start, folder / step.end, "--format", "json"});
  EXPECT_EQ(json["vertex_face"], step.vertexFace);
  EXPECT_EQ(json["edge_edge"], step.edgeEdge);
  EXPECT_EQ(json["face_face"], step.faceFace);
  if (kIsSanitized && step.faceFace > 1'000'000) return;  // lists as long take half a minute then
  const TempFolder own;
  expectSuccess(runProgram({"elements", folder / step.start, folder / step.end, "-o", own.path() / "x"}));
  const auto listed = [&](const char* key) { return pairsOfNpy(readBytes(own.path() / key)).size(); };
  EXPECT_EQ(listed("x.vertex_face.npy"), step.vertexFace);
  EXPECT_EQ(listed("x.edge_edge.npy"), step.edgeEdge);
  EXPECT_EQ(listed("x.face_face.npy"), step.faceFace);
}

INSTANTIATE_TEST_SUITE_P(
    Ccd, ElementsOfData,
    testing::Values(KnownStep{"cloth-ball/cloth_ball92.ply", "cloth-ball/cloth_ball93.ply", 1655541, 5197332, 3975589},
                    KnownStep{"armadillo-rollers/326.ply", "armadillo-rollers/327.ply", 2031902, 5068080, 2719315},
                    KnownStep{"cloth-funnel/227.ply", "cloth-funnel/228.ply", 7319, 33770, 43942}));

}  // namespace
}  // namespace allpairs::test
