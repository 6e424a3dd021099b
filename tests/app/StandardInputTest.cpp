// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Runs scripts in a folder that is the one for temporary files too, and must not hold any at the end.
class StandardInput : public testing::Test {
 protected:
  StandardInput() {
    m_folder.write("boxes.npy", npyBytes({cube(0, 0, 0), cube(1, 1, 1), cube(5, 5, 5)}));
    m_folder.write("boxes.csv", "a,0,0,0,2,2,2\nb,1,1,1,3,3,3\n");
    m_folder.write("part.obj",
                   "o part\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no other\nv 0 0 0\nv 1 0 0\nv 0 1 1\nf 4 5 6\n");
    std::filesystem::create_directory(m_folder.path() / "tmp");
  }

  [[nodiscard]] ProgramRun run(const std::string& script) const {
    const ProgramRun result =
        runScript("cd '" + m_folder.path().string() + "' && export TMPDIR=\"$PWD/tmp\" && " + script);
    EXPECT_TRUE(std::filesystem::is_empty(m_folder.path() / "tmp")) << "something is left behind";
    return result;
  }

  void expectSame(const std::string& script, const std::string& script2) const {
    const ProgramRun first = run(script);
    const ProgramRun second = run(script2);
    expectSuccess(first);
    EXPECT_EQ(first.out, second.out);
    EXPECT_NE(first.out, "");
  }

 private:
  TempFolder m_folder;
};

TEST_F(StandardInput, GivesWhatAFileGives) {
  const std::string file = "\"$0\" detect boxes.npy --format csv";
  expectSame("cat boxes.npy | \"$0\" detect - --input-format npy --format csv", file);
  expectSame("\"$0\" detect - --input-format npy --format csv -o - < boxes.npy", file);
  expectSame("cat boxes.npy | \"$0\" detect /dev/stdin --input-format npy --format csv -o /dev/stdout", file);
  expectSame("cat boxes.csv | \"$0\" detect - --input-format csv --format csv", "\"$0\" detect boxes.csv --format csv");
  expectSame("cat part.obj | \"$0\" detect - --input-format obj --format csv", "\"$0\" detect part.obj --format csv");
  expectSame("cat boxes.csv | \"$0\" info - --input-format csv", "\"$0\" info boxes.csv");
  expectSame("cat part.obj | \"$0\" elements - part.obj --input-format obj --format json | grep -c edge_edge",
             "\"$0\" elements part.obj part.obj --format json | grep -c edge_edge");
  expectSame(
      "\"$0\" generate brownian -n 20 --frames 3 -o - | \"$0\" track - --input-format npy --format csv | cut -d, -f1-4",
      "\"$0\" generate brownian -n 20 --frames 3 -o f.npy; \"$0\" track f.npy --format csv | cut -d, -f1-4");
}

TEST_F(StandardInput, IsWhatPagesAndReportsOfItAreCalled) {
  expectSuccess(run("\"$0\" view - --input-format csv -o page.html < boxes.csv"));
  EXPECT_EQ(run("grep -o '\"title\":\"[^\"]*' page.html").out, "\"title\":\"standard input\n");
  expectSuccess(run("mkfifo pipe.npy && { cat boxes.npy > pipe.npy & \"$0\" view boxes.csv pipe.npy -o both.html; }"));
  EXPECT_EQ(run("grep -o '\"title\":\"[^\"]*' both.html").out, "\"title\":\"boxes.csv, pipe.npy\n");
  expectSuccess(
      run("cat boxes.csv | { exec 7<&0; cat boxes.csv | { exec 8<&0; \"$0\" view /dev/fd/7 boxes.csv /dev/fd/8 "
          "--input-format csv -o pipes.html; }; }"));
  EXPECT_EQ(run("grep -o '\"title\":\"[^\"]*' pipes.html").out, "\"title\":\"pipe, boxes.csv, pipe 2\n");
  expectSuccess(run("\"$0\" report /dev/stdin --input-format csv -o report < boxes.csv"));
  EXPECT_EQ(run("grep -o '<title>[^<]*' report/index.html").out, "<title>standard input – clashes\n");
}

TEST_F(StandardInput, MayBeAPipeWithAName) {
  expectSame("mkfifo pipe.npy && { cat boxes.npy > pipe.npy & \"$0\" detect pipe.npy boxes.csv --format csv; }",
             "rm pipe.npy; cp boxes.npy pipe.npy; \"$0\" detect pipe.npy boxes.csv --format csv");
}

TEST_F(StandardInput, MayBePipesOfAnyNames) {
  const std::string files = " one/a-2.csv one/a.csv two/a.csv ";
  expectSame("mkdir one two && mkfifo" + files + "&& { for f in" + files +
                 "; do cat boxes.csv > $f & done; \"$0\" detect" + files + "--format csv; }",
             "\"$0\" detect boxes.csv boxes.csv boxes.csv --format csv");
}

TEST_F(StandardInput, IsWhatModelsAreNamedBy) {
  const std::string info = "\"$0\" info left/a.obj right/a.obj";
  expectSame(
      "mkdir left right && mkfifo left/a.obj right/a.obj && { cat part.obj > left/a.obj & "
      "cat part.obj > right/a.obj & " +
          info + "; }",
      "rm left/a.obj right/a.obj; cp part.obj left/a.obj; cp part.obj right/a.obj; " + info);
  const ProgramRun result = run(info + " - --input-format obj < part.obj");
  expectSuccess(result);
  for (const char* name : {"left/a.obj › other", "right/a.obj › other", "standard input › other"})
    EXPECT_NE(result.out.find(name), std::string::npos) << result.out;
}

TEST_F(StandardInput, IsNamedInResultsAndErrors) {
  const ProgramRun result = run("\"$0\" detect - --input-format obj --format json < part.obj");
  expectSuccess(result);
  EXPECT_EQ(nlohmann::json::parse(result.out)["models"][0]["file"], "standard input");
  expectFailure(run("printf 'a,0,0\\nb,1\\n' | \"$0\" detect - --input-format csv"), kBadInput,
                "allpairs: standard input:1");
  expectFailure(run("printf '' | \"$0\" detect - --input-format npy"), kBadInput, "allpairs: standard input: ");
}

TEST_F(StandardInput, IsNamedInErrorsOfTwoFiles) {
  expectFailure(run("\"$0\" elements - --input-format obj < part.obj"), kWrongUsage, "'standard input' has no END");
  expectFailure(run("grep -v other part.obj | \"$0\" elements - part.obj --input-format obj"), kBadInput,
                "allpairs: part.obj: holds 2 meshes where 'standard input' holds 1");
}

TEST_F(StandardInput, NeedsAFolderForTemporaryFiles) {
  expectFailure(run("TMPDIR=\"$PWD/nowhere\" \"$0\" detect - --input-format npy < boxes.npy"), kBadInput,
                "/nowhere: no folder for temporary files: ");
  expectFailure(run("TMPDIR=boxes.npy \"$0\" detect - --input-format npy < boxes.npy"), kBadInput,
                "allpairs: TMPDIR=boxes.npy: no folder for temporary files: ");
}

TEST_F(StandardInput, IsAskedForOnceAndWithItsFormat) {
  expectFailure(run("\"$0\" detect - < boxes.npy"), kWrongUsage, "standard input: --input-format must say what it is");
  expectFailure(run("\"$0\" detect - - --input-format npy < boxes.npy"), kWrongUsage, "can be read only once");
  expectFailure(run("\"$0\" detect boxes.npy --input-format npy"), kWrongUsage, "--input-format is for standard input");
  expectFailure(run("\"$0\" detect - --input-format ../x < boxes.npy"), kWrongUsage, "is no extension of a file");
}

TEST_F(StandardInput, ThatIsAFileIsNotReplaced) {
  const std::string same = " is standard input; the output needs another name";
  const std::string before = run("cat boxes.npy").out;
  for (const char* name : {"-", "/dev/stdin"}) {
    expectFailure(run(std::string("\"$0\" detect ") + name + " --input-format npy -o boxes.npy < boxes.npy"), kBadInput,
                  "boxes.npy:" + same);
  }
  expectFailure(run("ln -s boxes.npy link.npy; \"$0\" track - --input-format npy -o link.npy < boxes.npy"), kBadInput,
                "link.npy:" + same);
  expectFailure(run("cp boxes.npy page.html; \"$0\" view - --input-format npy -o page.html < page.html"), kBadInput,
                "page.html:" + same);
  EXPECT_EQ(run("cat boxes.npy").out, before);
  EXPECT_EQ(run("cat page.html").out, before);
  EXPECT_EQ(run("cat boxes.npy | \"$0\" detect - --input-format npy -o boxes.npy").status, 0) << "what a pipe brings";
}

TEST_F(StandardInput, AndOutputThatAreClosedAreErrors) {
  expectFailure(run("\"$0\" detect - --input-format npy < boxes.npy >&-"), kBadInput,
                "standard output: cannot be written");
  expectFailure(run("\"$0\" detect - --input-format npy <&-"), kBadInput, "standard input: cannot be read");
  expectFailure(run("\"$0\" detect - --input-format npy <&- >&-"), kBadInput, "standard input: cannot be read");
}

TEST_F(StandardInput, OfSeveralPipesIsTakenAwayWhenASignalEndsTheProgram) {
  const ProgramRun result =
      run("mkfifo a.csv b.csv && { cat boxes.csv > a.csv & \"$0\" detect a.csv b.csv & child=$!; exec 3>b.csv; "
          "echo 0,0,0,1,1,1 >&3; i=0; until [ -n \"$(find tmp -name b.csv -size +0)\" ] || [ $i = 600 ]; "
          "do sleep 0.05; i=$((i + 1)); done; [ $i = 600 ] || kill -TERM $child; exec 3>&-; wait $child; }");
  EXPECT_GT(result.status, 128) << "a shell's word for a signal";
}

TEST_F(StandardInput, IsTakenAwayWhenASignalEndsTheProgram) {
  const ProgramRun result =
      run("mkfifo pipe.npy && { \"$0\" detect pipe.npy & child=$!; exec 3>pipe.npy; i=0; "
          "until [ -n \"$(ls tmp)\" ] || [ $i = 600 ]; do sleep 0.05; i=$((i + 1)); done; kill -TERM $child; wait "
          "$child; }");
  EXPECT_GT(result.status, 128) << "a shell's word for a signal";
}

}  // namespace
}  // namespace allpairs::test
