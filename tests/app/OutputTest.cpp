// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Two boxes that touch, in a file of a folder.
std::string twoBoxes(const TempFolder& folder) {
  return folder.write("boxes.npy", npyBytes({cube(0, 0, 0), cube(1, 1, 1)}));
}

TEST(OutputFile, IsNotLeftInPartsByASignal) {
  for (const char* signal : {"TERM", "HUP"}) {
    const TempFolder folder;
    const ProgramRun run = runScript("\"$0\" generate uniform -n 20000000 -o '" + (folder.path() / "x.npy").string() +
                                     "' & sleep 0.1; kill -" + signal + " $!; wait $!");
    EXPECT_GT(run.status, 128) << "a shell's word for a signal";
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST(OutputFile, ThatMayNotGrowIsAnErrorAndNotLeft) {
  const TempFolder folder;
  const std::string file = folder.path() / "x.npy";
  const ProgramRun run = runScript("ulimit -f 16; \"$0\" generate uniform -n 9999 -o '" + file + "'");
  expectFailure(run, 3, file + ": cannot be written");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(OutputFile, ReplacesOneThatIsThere) {
  const TempFolder folder;
  const std::string boxes = twoBoxes(folder);
  const std::string target = folder.write("pairs.csv", "before");
  expectSuccess(runProgram({"detect", boxes, "-o", target}));
  EXPECT_EQ(readBytes(target), "first,second\n1,0\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

TEST(OutputFile, IsNoInput) {
  const TempFolder folder;
  const std::string boxes = twoBoxes(folder);
  const std::string cloth = folder.write("cloth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string table = folder.write("boxes.csv", "0,0,0,1,1,1\n0,0,0,1,1,1\n");
  const std::string before = readBytes(boxes);
  const std::string clothBefore = readBytes(cloth);
  const std::string link = folder.path() / "link.npy";
  std::filesystem::create_symlink("boxes.npy", link);
  std::filesystem::create_directory(folder.path() / "parts");
  const std::string part = folder.path() / "parts" / "part.obj";
  std::filesystem::copy_file(cloth, part);
  const std::string page = folder.path() / "page.html";
  std::filesystem::create_symlink("parts/part.obj", page);
  const std::string margins = folder.write("margins.npy", "not read yet");
  const std::string other = folder.write("other.npy", before);
  const std::string scene = folder.write(
      "a.scn", R"(<Node name="root"><MeshOBJLoader name="loader" filename="cloth.obj"/><MeshTopology src="@loader"/>
                  <MechanicalObject/><TriangleCollisionModel/></Node>)");
  const std::vector<std::vector<std::string>> commands = {
      {"detect", scene, "--format", "csv", "-o", cloth},
      {"detect", folder.path() / "parts", "--format", "csv", "-o", part},
      {"view", folder.path() / "parts", "-o", page},
      {"detect", boxes, "-o", boxes},
      {"detect", table, "-o", table},
      {"detect", boxes, "-o", link},
      {"track", other, boxes, "-o", boxes},
      {"track", folder.path() / "parts", "--format", "csv", "-o", part},
      {"elements", folder.path() / "parts", scene, "--format", "json", "-o", part},
      {"elements", scene, scene, "--format", "json", "-o", cloth},
      {"view", "--sequence", folder.path() / "parts", "-o", page},
      {"elements", cloth, "--format", "json", "-o", cloth},
      {"join", boxes, "-o", boxes},
      {"join", other, "-o", link, "--with", boxes},
      {"join", other, "-o", margins, "--margins", margins}};
  for (const std::vector<std::string>& command : commands) {
    const ProgramRun run = runProgram(command);
    EXPECT_EQ(run.status, 3) << command.front() << ": " << run.err;
    EXPECT_NE(run.err.find("is an input; the output needs another name"), std::string::npos) << run.err;
  }
  EXPECT_TRUE(readBytes(boxes) == before);
  EXPECT_TRUE(readBytes(cloth) == clothBefore);
  EXPECT_TRUE(readBytes(part) == clothBefore);
  EXPECT_EQ(readBytes(margins), "not read yet");
}

TEST(OutputFile, MayHaveANameAsLongAsAnyFile) {
  const TempFolder folder;
  const std::string name = folder.path() / (std::string(251, 'a') + ".csv");
  expectSuccess(runProgram({"detect", twoBoxes(folder), "-o", name}));
  EXPECT_EQ(readBytes(name), "first,second\n1,0\n");
}

TEST(OutputFile, ThatIsALinkToItselfIsAnError) {
  const TempFolder folder;
  const std::string link = folder.path() / "link.csv";
  std::filesystem::create_symlink("link.csv", link);
  expectFailure(runProgram({"detect", twoBoxes(folder), "-o", link}), 3, link + ": is a link that leads nowhere");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(OutputFile, ThatMeansADescriptorIsWrittenThere) {
  const TempFolder folder;
  const std::string boxes = twoBoxes(folder);
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    const ProgramRun run =
        runScript("echo before; \"$0\" detect '" + boxes + "' --format csv -o " + name + "; echo after");
    EXPECT_EQ(run.out, "before\nfirst,second\n1,0\nafter\n") << name;
    EXPECT_EQ(run.err, "");
  }
}

TEST(OutputFile, IsOfTheFormatThatItsExtensionSaysInAnyCase) {
  const TempFolder folder;
  const std::string target = folder.path() / "pairs.CSV";
  expectSuccess(runProgram({"detect", twoBoxes(folder), "-o", target}));
  EXPECT_EQ(readBytes(target), "first,second\n1,0\n");
}

TEST(OutputFile, WithoutANameIsWrongUsage) {
  const TempFolder folder;
  expectFailure(runProgram({"detect", twoBoxes(folder), "-o", ""}), 2, "-o, --output: the value is empty (see");
  expectFailure(runProgram({"generate", "uniform", "-o", ""}), 2, "-o, --output: the value is empty (see");
}

TEST(OutputFile, OfANameThatEndsInNoFormatIsWrongUsage) {
  const TempFolder folder;
  const std::string boxes = twoBoxes(folder);
  for (const char* name : {"pairs.xml", "pairs.npz", "a.b/../pairs.txt.bak"}) {
    const std::string file = folder.path() / name;
    expectFailure(runProgram({"detect", boxes, "-o", file}), 2,
                  "ends in no format that can be written, which are .txt, .csv");
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  expectFailure(runProgram({"view", boxes, "-o", folder.path() / "page.pdf"}), 2, "a page is written as .html");
  for (const char* name : {"report.html", "clashes.BCF", "clashes.csv"}) {
    expectFailure(runProgram({"report", boxes, "-o", folder.path() / name}), 2, "a report is a folder");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name));
  }
  std::filesystem::create_directory(folder.path() / "old.html");
  for (const char* name : {"v1.2", "old.html"})
    expectSuccess(runProgram({"report", boxes, "-o", folder.path() / name}));
  for (const char* name : {"pairs", "pairs.txt", "pairs.CSV", ".pairs"}) {
    expectSuccess(runProgram({"detect", boxes, "-o", folder.path() / name}));
  }
  expectSuccess(runProgram({"detect", boxes, "-o", folder.path() / "pairs.xml", "--format", "csv"}));
}

TEST(OutputFile, ThatMayNotBeWrittenIsNotReplaced) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write every file: a read-only one is not tried";
  const TempFolder folder;
  const std::string boxes = twoBoxes(folder);
  const std::string target = folder.write("pairs.csv", "before");
  std::filesystem::permissions(target, std::filesystem::perms::owner_read);
  expectFailure(runProgram({"detect", boxes, "-o", target}), 3, target + ": cannot be replaced");
  EXPECT_EQ(readBytes(target), "before");
}

TEST(OutputFolder, ThatMayNotBeWrittenIsRefusedBeforeTheWork) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write to every folder: a read-only one is not tried";
  using std::filesystem::perms;
  const TempFolder folder;
  const std::string out = folder.path() / "report";
  expectSuccess(runProgram({"report", twoBoxes(folder), "-o", out}));
  const std::string table = readBytes(out + "/clashes.csv");
  const std::string bad = folder.write("bad.csv", "no box\n");  // which the work would find out
  const std::string may = ": Permission denied\n";
  std::filesystem::permissions(out + "/pictures", perms::owner_read | perms::owner_exec);
  expectFailure(runProgram({"report", bad, "-o", out}), 3, ": " + out + "/pictures: cannot be written to" + may);
  std::filesystem::permissions(out, perms::owner_read | perms::owner_exec);
  expectFailure(runProgram({"report", bad, "-o", out}), 3, ": " + out + ": cannot be written to" + may);
  for (const char* name : {"/new", "/new/", "/new/er"})
    expectFailure(runProgram({"report", bad, "-o", out + name}), 3,
                  ": " + out + name + ": cannot create this folder" + may);
  std::filesystem::permissions(out, perms::owner_all);
  std::filesystem::permissions(out + "/pictures", perms::owner_all);
  EXPECT_EQ(readBytes(out + "/clashes.csv"), table);
  EXPECT_FALSE(std::filesystem::exists(out + "/new"));
}

}  // namespace
}  // namespace allpairs::test
