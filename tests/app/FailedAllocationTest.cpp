// SPDX-License-Identifier: MIT
// Allocations of each command fail, one in a run: the result is whole, or there is one line and the status for it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <new>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "CommandLine.h"
#include "Expect.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

constexpr unsigned kSeconds = 60;  // a run that hangs ends by a signal
constexpr const char* kBefore = "what was there before";

/// Memory that a process shares with those that it forks.
class SharedFlag {
 public:
  SharedFlag() : m_flag(::mmap(nullptr, 1, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (m_flag == MAP_FAILED) throw std::bad_alloc();
  }
  ~SharedFlag() { ::munmap(m_flag, 1); }
  SharedFlag(const SharedFlag&) = delete;
  SharedFlag& operator=(const SharedFlag&) = delete;

  void set(bool value) const { *static_cast<volatile bool*>(m_flag) = value; }
  [[nodiscard]] bool get() const { return *static_cast<volatile bool*>(m_flag); }

 private:
  void* m_flag;
};

/// The allocation that fails in a run; none for k = 0.
struct FailedAllocation {
  std::uint64_t k = 0;
  Failing failing = Failing::Once;
};

/// The program in a process of its own, which is a copy of this one: starting the program takes ten times as long.
class ForkedProgram {
 public:
  ForkedProgram(std::vector<std::string> arguments, std::filesystem::path folder)
      : m_words(std::move(arguments)), m_folder(std::move(folder)) {
    m_words.insert(m_words.begin(), "allpairs");
    for (std::string& word : m_words) m_pointers.push_back(word.data());
  }

  ProgramRun run(FailedAllocation fault) {
    std::fflush(nullptr);
    m_happened.set(false);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) runAndEnd(fault);
    int status = 0;
    if (::waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait for the program");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readBytes(m_folder / "out"), readBytes(m_folder / "err")};
  }

  /// How many allocations a run makes.
  [[nodiscard]] std::uint64_t allocations() {
    std::uint64_t fewest = 0, most = 1;
    for (; fails(most); most *= 2) fewest = most;
    while (most - fewest > 1) {
      const std::uint64_t middle = (fewest + most) / 2;
      (fails(middle) ? fewest : most) = middle;
    }
    return fewest;
  }

 private:
  /// Whether there is a k-th allocation.
  bool fails(std::uint64_t k) {
    const ProgramRun run = this->run({k, Failing::Once});
    return m_happened.get() || run.status < 0;
  }

  static void redirect(int descriptor, const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
    ::close(file);
  }

  [[noreturn]] void runAndEnd(FailedAllocation fault) {
    redirect(STDOUT_FILENO, m_folder / "out");
    redirect(STDERR_FILENO, m_folder / "err");
    ::alarm(kSeconds);
    if (fault.k > 0) startFailing(fault.k, fault.failing);
    const int status = app::runCommandLine(static_cast<int>(m_pointers.size()), m_pointers.data());
    m_happened.set(stopFailing());
    std::fflush(nullptr);
    ::_exit(status);
  }

  std::vector<std::string> m_words;
  std::vector<char*> m_pointers;
  std::filesystem::path m_folder;
  SharedFlag m_happened;
};

/// What a folder holds, but for times, which differ from run to run: the bytes of each file by its name.
std::map<std::string, std::string> contentsOf(const std::filesystem::path& folder) {
  static const std::regex times(R"~((econds|Ms)": ?(\[[^\]]*|[-+.e0-9]+))~");
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string bytes = readBytes(entry.path());
    const bool isJson = entry.path().extension() == ".json";
    contents[entry.path().filename()] = isJson ? std::regex_replace(bytes, times, "$1") : bytes;
  }
  return contents;
}

/// One command line, which writes into a folder of its own, "results".
class Scene {
 public:
  Scene() { std::filesystem::create_directory(results()); }

  [[nodiscard]] std::filesystem::path results() const { return m_folder.path() / "results"; }
  [[nodiscard]] const TempFolder& folder() const { return m_folder; }

  /// Lets allocations fail: some of those that make and read the options, which all commands do, and most of the others.
  void check(const std::vector<std::string>& arguments) {
    ForkedProgram program(arguments, m_folder.path());
    expectSuccess(program.run({}));
    const auto wanted = contentsOf(results());
    ASSERT_FALSE(wanted.empty());
    ForkedProgram options({arguments[0], "nowhere.npy", "nowhere.npy"}, m_folder.path());
    const std::uint64_t setup = options.allocations() * 9 / 10, all = program.allocations();
    ASSERT_GT(all, setup + 100) << "hardly anything allocates";
    for (const Failing failing : {Failing::Once, Failing::Onwards}) {
      for (std::uint64_t k = 1; k <= all; k += 1 + (k < setup ? setup / kSomeRuns : (all - setup) / kMostRuns)) {
        SCOPED_TRACE("allocation " + std::to_string(k) +
                     (failing == Failing::Once ? " fails" : " and later ones fail"));
        const bool isNew = k % 2 == 0;
        prepare(wanted, isNew);
        const ProgramRun run = program.run({k, failing});
        expectWholeOrNothing(run, wanted, isNew);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }

 private:
  static constexpr std::uint64_t kSomeRuns = 20, kMostRuns = 200;

  /// The results are not there yet, or are those of another run.
  void prepare(const std::map<std::string, std::string>& wanted, bool isNew) const {
    std::filesystem::remove_all(results());
    std::filesystem::create_directory(results());
    if (isNew) return;
    for (const auto& [name, bytes] : wanted) m_folder.write("results/" + name, kBefore);
  }

  void expectWholeOrNothing(const ProgramRun& run, const std::map<std::string, std::string>& wanted, bool isNew) const {
    run.status == 0 ? expectSuccess(run) : expectFailure(run, kBadInput, "");
    const auto found = contentsOf(results());
    for (const auto& [name, bytes] : found) {
      ASSERT_TRUE(wanted.contains(name)) << name << " is left";
      const bool isWhole = bytes == wanted.at(name);
      EXPECT_TRUE(isWhole || (run.status != 0 && !isNew && bytes == kBefore)) << name << ": " << bytes;
    }
    if (run.status == 0 || !isNew) {
      EXPECT_EQ(found.size(), wanted.size());
    }
  }

  TempFolder m_folder;
};

std::string someBoxes(const Scene& scene) {
  return scene.folder().write("boxes.npy", npyBytes(toDouble(randomBoxes(80, 7))));
}

constexpr const char* kMesh = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 2\nv 2 1 2\nv 1 2 2\no a\nf 1 2 3\no b\nf 4 5 6\n";
constexpr const char* kMoved = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 2 1 -1\nv 1 2 -1\no a\nf 1 2 3\no b\nf 4 5 6\n";

TEST(FailedAllocationOfTheProgram, DetectBoxes) {
  for (const char* name : {"pairs.npy", "pairs.csv", "pairs.json"}) {
    Scene scene;
    scene.check({"detect", someBoxes(scene), "--threads", "1", "-o", scene.results() / name});
  }
}

TEST(FailedAllocationOfTheProgram, DetectMesh) {
  Scene scene;
  const std::string mesh = scene.folder().write("mesh.obj", kMesh);
  scene.check({"detect", mesh, "--distance", "3", "-o", scene.results() / "pairs.json"});
}

TEST(FailedAllocationOfTheProgram, DetectGltf) {
  constexpr const char* kGltf =
      R"({"asset": {"version": "2.0"}, "nodes": [{"name": "a", "mesh": 0}, {"name": "b", "mesh": 0}], "meshes": [)"
      R"({"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, "componentType": 5126, )"
      R"("count": 3, "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, )"
      R"("uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  Scene scene;
  const std::string mesh = scene.folder().write("mesh.gltf", kGltf);
  scene.check({"detect", mesh, "-o", scene.results() / "pairs.csv"});
}

TEST(FailedAllocationOfTheProgram, DetectScene) {
  constexpr const char* kScene =
      "<Node name='root'>\n<DefaultPipeline/><BruteForceBroadPhase/><MinProximityIntersection alarmDistance='3'/>\n"
      "<Node name='a'><MeshOBJLoader name='m' filename='mesh.obj'/><MeshTopology src='@m'/><MechanicalObject "
      "src='@m'/>\n"
      "<TriangleCollisionModel/></Node>\n<Node name='b'><MechanicalObject template='Rigid3d' position='1 1 1 0 0 0 "
      "1'/>\n"
      "<OBBCollisionModel extents='1 1 1'/></Node></Node>\n";
  Scene scene;
  scene.folder().write("mesh.obj", kMesh);
  const std::string file = scene.folder().write("scene.scn", kScene);
  scene.check({"detect", file, "-o", scene.results() / "pairs.json"});
}

TEST(FailedAllocationOfTheProgram, Track) {
  std::vector<Box> boxes = toDouble(randomBoxes(60, 7));
  const std::vector<Box> others = toDouble(randomBoxes(60, 8));
  boxes.insert(boxes.end(), others.begin(), others.end());
  Scene scene;
  const std::string frames = scene.folder().write("frames.npy", npyBytes(boxes, {.shape = "(2, 60, 6)"}));
  scene.check({"track", frames, "-o", scene.results() / "pairs.json"});
}

TEST(FailedAllocationOfTheProgram, Elements) {
  Scene scene;
  const std::string start = scene.folder().write("start.obj", kMesh);
  const std::string end = scene.folder().write("end.obj", kMoved);
  scene.check({"elements", start, end, "-o", scene.results() / "report.json"});
}

TEST(FailedAllocationOfTheProgram, Generate) {
  Scene scene;
  scene.check({"generate", "uniform", "-n", "50", "--sorted", "-o", scene.results() / "boxes.npy"});
  scene.check({"generate", "brownian", "-n", "50", "--frames", "3", "-o", scene.results() / "boxes.npy"});
}

TEST(FailedAllocationOfTheProgram, Join) {
  Scene scene;  // each run goes on with what the one before has left
  scene.check({"join", someBoxes(scene), "--threads", "1", "--memory", "64M", "--resume", "--work",
               scene.folder().path() / "work", "-o", scene.results() / "pairs.npy"});
}

TEST(FailedAllocationOfTheProgram, ALinkStaysALink) {
  Scene scene;  // where the file isn't there yet, the link leads nowhere
  const std::string boxes = someBoxes(scene);
  const std::string link = scene.folder().path() / "link.npy";
  scene.folder().write("results/pairs.npy", kBefore);
  std::filesystem::create_symlink(scene.results() / "pairs.npy", link);
  scene.check({"detect", boxes, "-o", link});
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

}  // namespace
}  // namespace allpairs::test
