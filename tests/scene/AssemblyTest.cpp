// SPDX-License-Identifier: MIT
// The assembly of each model: what is below the node of its file where it first branches.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "allpairs/scene/ReadInput.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Assemblies = std::vector<std::string>;

/// Of the models of a glTF file with these nodes, the first of which is the root; each with `"mesh": 0` is a model.
Assemblies assembliesOf(const std::string& nodes) {
  const TempFolder folder;
  const scene::Scene scene = scene::readInput(folder.write(
      "a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" + nodes + R"(],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})"));
  Assemblies assemblies;
  for (const scene::ModelSource& source : scene.sources) assemblies.push_back(source.assembly);
  return assemblies;
}

TEST(Assembly, IsWhatIsBelowTheFirstBranchUnderANameOfItsOwn) {
  EXPECT_EQ(assembliesOf(R"({"name": "all", "children": [1]}, {"name": "machine", "children": [2, 5, 6, 7, 8]},
{"name": "arm", "children": [3, 4]}, {"name": "a", "mesh": 0}, {"name": "b", "mesh": 0}, {"name": "arm", "mesh": 0},
{"mesh": 0}, {"mesh": 0}, {"name": "camera"})"),
            (Assemblies{"arm", "arm", "arm#2", "node", "node#2"}));
}

TEST(Assembly, HasNoNumberThatIsAnothersName) {
  EXPECT_EQ(assembliesOf(R"({"name": "all", "children": [1, 2, 3]}, {"name": "arm", "mesh": 0},
{"name": "arm", "mesh": 0}, {"name": "arm#2", "mesh": 0})"),
            (Assemblies{"arm", "arm#3", "arm#2"}));
}

TEST(Assembly, IsNoneWhereNothingBranchesOrAModelIsAboveTheBranch) {
  EXPECT_EQ(assembliesOf(R"({"name": "all", "children": [1, 2]}, {"name": "a", "mesh": 0}, {"name": "empty"})"),
            (Assemblies{""}));
  EXPECT_EQ(assembliesOf(R"({"name": "all", "mesh": 0, "children": [1, 2]}, {"name": "a", "mesh": 0},
{"name": "b", "mesh": 0})"),
            (Assemblies{"", "", ""}));
}

}  // namespace
}  // namespace allpairs::test
