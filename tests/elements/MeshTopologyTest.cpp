// SPDX-License-Identifier: MIT
#include "allpairs/elements/MeshTopology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "allpairs/Error.h"
#include "support/AllocationCount.h"

namespace allpairs::elements {
namespace {

using testing::ElementsAre;
using Indices = std::vector<std::uint32_t>;

std::string messageOf(const MeshView& mesh) {
  try {
    const MeshTopology topology(mesh);
  } catch (const InvalidArgument& problem) {
    return problem.what();
  }
  return "";
}

TEST(MeshTopology, NamesEachEdgeOfASquareOnceInOrder) {
  const Indices triangles{2, 1, 0, 3, 2, 0};
  const MeshTopology topology(MeshView{4, triangles});
  EXPECT_THAT(topology.edges(), ElementsAre(Edge{0, 1}, Edge{0, 2}, Edge{0, 3}, Edge{1, 2}, Edge{2, 3}));
  EXPECT_THAT(topology.triangles(), ElementsAre(Triangle{2, 1, 0}, Triangle{3, 2, 0}));
  EXPECT_EQ(topology.counts(), (ElementCounts{4, 5, 2}));
  EXPECT_TRUE(topology.meshOfVertex().empty());
}

TEST(MeshTopology, OfManyMeshesTakesMemoryByTheirSize) {
  const Indices triangle{0, 1, 2};
  const std::vector<MeshView> meshes(20000, MeshView{3, triangle});
  const std::size_t before = test::allocatedBytes();
  const MeshTopology topology(meshes);
  EXPECT_EQ(topology.triangles().size(), meshes.size());
  EXPECT_LT(test::allocatedBytes() - before, 1000 * meshes.size());
}

TEST(MeshTopology, NumbersSeveralMeshesThrough) {
  const Indices triangle{0, 1, 2};
  const std::vector<MeshView> meshes{{4, triangle}, {0, {}}, {3, triangle}};
  const MeshTopology topology(meshes);
  EXPECT_EQ(topology.meshCount(), 3U);
  EXPECT_EQ(topology.before(1), (ElementCounts{4, 3, 1}));
  EXPECT_EQ(topology.before(2), (ElementCounts{4, 3, 1}));
  EXPECT_EQ(topology.before(3), (ElementCounts{7, 6, 2}));
  EXPECT_THAT(topology.edges(), ElementsAre(Edge{0, 1}, Edge{0, 2}, Edge{1, 2}, Edge{4, 5}, Edge{4, 6}, Edge{5, 6}));
  EXPECT_THAT(topology.triangles(), ElementsAre(Triangle{0, 1, 2}, Triangle{4, 5, 6}));
  EXPECT_THAT(topology.meshOfVertex(), ElementsAre(0U, 0U, 0U, 0U, 2U, 2U, 2U));
  EXPECT_THROW(static_cast<void>(topology.before(4)), InvalidArgument);
  EXPECT_EQ(topology.vertexCount(0), 4U);
  EXPECT_EQ(topology.vertexCount(1), 0U);
  EXPECT_EQ(topology.vertexCount(2), 3U);
  EXPECT_THROW(static_cast<void>(topology.vertexCount(3)), InvalidArgument);
}

TEST(MeshTopology, KeepsATriangleThatNamesAVertexTwiceWithoutAnEdgeToItself) {
  const Indices triangles{1, 1, 0, 2, 2, 2};
  const MeshTopology topology(MeshView{3, triangles});
  EXPECT_EQ(topology.counts(), (ElementCounts{3, 1, 2}));
  EXPECT_THAT(topology.edges(), ElementsAre(Edge{0, 1}));
}

TEST(MeshTopology, SortsTheManyEdgesOfAHub) {
  Indices triangles;
  for (std::uint32_t i = 100; i >= 2; --i) triangles.insert(triangles.end(), {i, 0, i - 1});
  const MeshTopology topology(MeshView{101, triangles});
  std::vector<Edge> expected;
  for (std::uint32_t i = 1; i <= 100; ++i) expected.push_back({0, i});
  for (std::uint32_t i = 1; i < 100; ++i) expected.push_back({i, i + 1});
  EXPECT_THAT(topology.edges(), testing::ElementsAreArray(expected));
}

TEST(MeshTopology, OfNothingHasNoElements) {
  EXPECT_EQ(MeshTopology(std::span<const MeshView>()).counts(), ElementCounts());
  EXPECT_EQ(MeshTopology(MeshView{}).counts(), ElementCounts());
  EXPECT_EQ(MeshTopology(MeshView{5, {}}).counts(), (ElementCounts{5, 0, 0}));
}

TEST(MeshTopology, RefusesAnIndexPastTheVerticesNamingTheTriangle) {
  EXPECT_EQ(messageOf({3, Indices{0, 1, 2, 0, 1, 3}}), "mesh 0: triangle 1 names vertex 3 of 3");
}

TEST(MeshTopology, RefusesIndicesThatAreNoRowsOfThree) {
  EXPECT_EQ(messageOf({3, Indices{0, 1, 2, 0}}), "mesh 0: its triangles are 4 indices, which is no multiple of 3");
}

TEST(MeshTopology, RefusesMoreVerticesThanAnIndexCanNumber) {
  EXPECT_EQ(messageOf({std::size_t{1} << 32U, {}}), "mesh 0: more than 2^32 - 1 vertices or triangles in all");
}

}  // namespace
}  // namespace allpairs::elements
