// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "Expect.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

constexpr const char* kScene =
    "<Node name='root'><CollisionPipeline/><BruteForceDetection/>\n<MeshTopology name='m' "
    "filename='../a.obj'/><MechanicalObject/><TriangleModel/></Node>";

TEST(HostileInput, NamesFilesOutsideOnlyWhereTheUserAllowsIt) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "in");
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string scene = folder.write("in/a.scn", kScene);
  for (const char* command : {"info", "detect"}) {
    expectFailure(runProgram({command, scene}), kBadInput, "--allow-outside");
    expectSuccess(runProgram({command, scene, "--allow-outside"}));
    expectSuccess(runProgram({command, scene, "--data", folder.path().string()}));
  }
}

TEST(HostileInput, ThatIsALinkToItselfLeadsNowhere) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "in");
  const std::string link = folder.path() / "in/loop.obj";
  std::filesystem::create_symlink("loop.obj", link);
  for (const std::string& input : {link, (folder.path() / "in").string()})
    expectFailure(runProgram({"detect", input}), kBadInput, "loop.obj: is a link that leads nowhere");
}

TEST(HostileInput, TakesNoMoreMemoryThanTheUserAllows) {
  const TempFolder folder;
  const std::string mesh = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* command : {"info", "detect", "track"}) {
    expectSuccess(runProgram({command, mesh, "--max-memory", "1M"}));
    expectFailure(runProgram({command, mesh, "--max-memory", "100"}), kBadInput, "takes more than 100 bytes");
  }
  expectFailure(runProgram({"elements", mesh, mesh, "--max-memory", "100"}), kBadInput, "takes more than 100 bytes");
  expectFailure(runProgram({"info", mesh, "--max-memory", "1"}), kBadInput, "takes more than 1 byte of memory");
  for (const char* size : {"0", "-1", "1.5G", "10X", "99999999999T", "M"}) {
    expectFailure(runProgram({"info", mesh, std::string("--max-memory=") + size}), kWrongUsage, "--max-memory");
  }
}

TEST(HostileInput, IsComplainedAboutInOneShortLine) {
  const TempFolder folder;
  const std::string mesh = folder.write("a.obj", "v 0 0 0\nf 1 1 " + std::string(139'000, 'x') + "\x1b[31m\n");
  const ProgramRun run = runProgram({"info", mesh});
  expectFailure(run, kBadInput, "a.obj:2: ");
  EXPECT_LE(run.err.size(), 501U) << "with its line break";
  EXPECT_EQ(run.err.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace allpairs::test
