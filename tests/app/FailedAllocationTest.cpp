// SPDX-License-Identifier: MIT
// Allocations of each command fail, one in a run: the result is whole, or there is one line and the status for it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <new>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "CommandLine.h"
#include "Expect.h"
#include "allpairs/parallel/TbbExecutor.h"
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
    const std::string err = std::regex_replace(readBytes(m_folder / "err"), m_fcl, "");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readBytes(m_folder / "out"), err};
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
    parallel::TbbExecutor(2).run(2,
                                 [](std::size_t) {});  // oneTBB's first use ends the program where there is no memory
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
  std::regex m_fcl{"BVH Error! Out of memory.*\n"};  ///< What FCL says by itself.
};

/// A file's bytes, but for times, which differ from run to run: in JSON, also where a page has some.
std::string bytesBesideTimes(const std::filesystem::path& file) {
  static const std::regex times(R"~((econds|Ms)": ?(\[[^\]]*|[-+.e0-9]+))~");
  constexpr std::string_view kBegin = "id=\"allpairs-scene\">";
  const std::string bytes = readBytes(file);
  if (file.extension() == ".json") return std::regex_replace(bytes, times, "$1");
  const std::size_t begin = bytes.find(kBegin);
  if (begin == std::string::npos) return bytes;
  const std::size_t end = bytes.find("</script>", begin);
  return bytes.substr(0, begin) + std::regex_replace(bytes.substr(begin, end - begin), times, "$1") + bytes.substr(end);
}

using Contents = std::map<std::string, std::string>;

/// What a folder holds: each file by its name. Of a folder in it the name ends with a slash.
Contents contentsOf(const std::filesystem::path& folder) {
  Contents contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder);
    if (entry.is_directory()) {
      contents[name + '/'];
    } else {
      contents[name] = bytesBesideTimes(entry.path());
    }
  }
  return contents;
}

/// One command line, which writes into a folder of its own, "results".
class Scene {
 public:
  Scene() { std::filesystem::create_directory(results()); }

  [[nodiscard]] std::filesystem::path results() const { return m_folder.path() / "results"; }
  [[nodiscard]] const TempFolder& folder() const { return m_folder; }

  /// Lets allocations fail: some of those that make and read the options, which all commands do, and most of the
  /// others.
  void check(const std::vector<std::string>& arguments) {
    ForkedProgram program(arguments, m_folder.path());
    expectSuccess(program.run({}));
    const Contents wanted = contentsOf(results());
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
  void prepare(const Contents& wanted, bool isNew) const {
    std::filesystem::remove_all(results());
    std::filesystem::create_directory(results());
    if (isNew) return;
    for (const auto& [name, bytes] : wanted) {
      if (name.back() != '/') m_folder.write("results/" + name, kBefore);
    }
  }

  void expectWholeOrNothing(const ProgramRun& run, const Contents& wanted, bool isNew) const {
    run.status == 0 ? expectSuccess(run) : expectFailure(run, kBadInput, "");
    const Contents found = contentsOf(results());
    for (const auto& [name, bytes] : found) {
      ASSERT_TRUE(wanted.contains(name)) << name << " is left";
      const bool isWhole = bytes == wanted.at(name);
      EXPECT_TRUE(isWhole || (run.status != 0 && !isNew && bytes == kBefore)) << name << ": " << bytes.substr(0, 100);
    }
    if (run.status == 0 || !isNew || !found.empty()) {
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

TEST(FailedAllocationOfTheProgram, DetectFolder) {
  Scene scene;
  scene.folder().write("meshes/a.obj", kMesh);
  scene.folder().write("meshes/b.obj", kMoved);
  scene.check({"detect", scene.folder().path() / "meshes", "-o", scene.results() / "pairs.csv"});
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
      "<Node name='root'>\n<CollisionPipeline/><BruteForceDetection/><CollisionResponse/><MinProximityIntersection "
      "alarmDistance='3'/>\n"
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

TEST(FailedAllocationOfTheProgram, DetectMeshThatAnotherProcessReads) {
  constexpr const char* kCollada =
      R"(<COLLADA version="1.4.1"><asset/><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" )"
      R"(count="9">0 0 0 4 0 0 0 4 0</float_array><technique_common><accessor source="#a" count="3" stride="3"><param )"
      R"(name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>)"
      R"(</source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input )"
      R"(semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>)"
      R"(<library_visual_scenes><visual_scene id="s"><node id="m"><instance_geometry url="#g"/></node><node id="n">)"
      R"(<translate>1 1 2</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene>)"
      R"(<instance_visual_scene url="#s"/></scene></COLLADA>)";
  Scene scene;  // allocations fail there, too
  const std::string mesh = scene.folder().write("mesh.dae", kCollada);
  scene.check({"detect", mesh, "--distance", "3", "-o", scene.results() / "pairs.json"});
}

TEST(FailedAllocationOfTheProgram, ViewModels) {
  Scene scene;
  const std::string mesh = scene.folder().write("mesh.obj", kMesh);
  scene.check({"view", mesh, "--clearance", "3", "-o", scene.results() / "page.html"});
}

TEST(FailedAllocationOfTheProgram, ViewBoxes) {
  Scene scene;
  scene.check({"view", someBoxes(scene), "-o", scene.results() / "page.html"});
}

TEST(FailedAllocationOfTheProgram, ViewFrames) {
  Scene scene;
  const std::string start = scene.folder().write("start.obj", kMesh);
  const std::string end = scene.folder().write("end.obj", kMoved);
  scene.check({"view", "--sequence", start, end, "-o", scene.results() / "page.html"});
}

TEST(FailedAllocationOfTheProgram, Report) {
  ASSERT_EQ(::setenv("SOURCE_DATE_EPOCH", "86400", 1), 0);  // the same date in each
  Scene scene;
  const std::string mesh = scene.folder().write("mesh.obj", kMesh);
  const std::string moved = scene.folder().write("moved.obj", kMoved);
  const std::string earlier = scene.folder().path() / "earlier";
  expectSuccess(ForkedProgram({"report", mesh, "--clearance", "3", "-o", earlier}, scene.folder().path()).run({}));
  scene.check({"report", moved, "--clearance", "3", "--since", earlier, "-o", scene.results() / "report"});
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
