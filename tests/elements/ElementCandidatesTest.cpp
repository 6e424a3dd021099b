// SPDX-License-Identifier: MIT
#include "allpairs/elements/ElementCandidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <random>
#include <string>

#include "ElementOracle.h"
#include "allpairs/Error.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Sanitizers.h"

namespace allpairs::elements {
namespace {

using test::candidatesOf;
using test::ElementOracle;
using test::MovingMesh;
using test::toVector;
using test::Wanted;

/// A sheet of n by n squares, rolled up so that it meets itself, whose vertices move by about a square.
MovingMesh rolledSheet(std::uint32_t n, unsigned seed) {
  std::mt19937 generator(seed);
  const auto jitter = [&] { return (static_cast<double>(generator()) * 0x1p-32 - 0.5) * 1.2; };
  MovingMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i) {
    const double turn = 0.35 * i;
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double radius = 2.5 + 0.12 * turn;
      mesh.start.insert(mesh.start.end(), {radius * std::cos(turn), radius * std::sin(turn), 1.0 * j});
      if (i < n && j < n) {
        const std::uint32_t a = i * (n + 1) + j;
        mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, a + n + 1, a + 1, a + n + 2, a + n + 1});
      }
    }
  }
  for (const double x : mesh.start) mesh.end.push_back(x + jitter());
  return mesh;
}

/// The same with positions that float32 holds.
MovingMesh rounded(MovingMesh mesh) {
  for (double& x : mesh.start) x = test::asFloat32(x);
  for (double& x : mesh.end) x = test::asFloat32(x);
  return mesh;
}

void expectEqual(ElementCandidates& candidates, const ElementOracle& oracle, const Wanted& wanted = {}) {
  EXPECT_EQ(toVector(candidates.find(CandidateKind::VertexFace)), oracle.vertexFace(wanted));
  EXPECT_EQ(toVector(candidates.find(CandidateKind::EdgeEdge)), oracle.edgeEdge(wanted));
  EXPECT_EQ(toVector(candidates.find(CandidateKind::FaceFace)), oracle.faceFace(wanted));
}

std::string messageOf(const MovingMesh& mesh) {
  try {
    candidatesOf({mesh});
  } catch (const InvalidArgument& problem) {
    return problem.what();
  }
  return "";
}

const MovingMesh kTriangle{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};

MovingMesh shifted(MovingMesh mesh, double x, double y, double z) {
  const double by[] = {x, y, z};
  for (std::size_t i = 0; i < mesh.start.size(); ++i) {
    mesh.start[i] += by[i % 3];
    mesh.end[i] += by[i % 3];
  }
  return mesh;
}

TEST(ElementCandidates, OfASheetThatMeetsItselfAreTheDoubleLoops) {
  constexpr std::uint32_t kSquares = test::kIsSanitized ? 20 : 24;  // 18 go once around
  for (const MovingMesh& mesh : {rolledSheet(kSquares, 1), rounded(rolledSheet(kSquares, 2))}) {
    const ElementOracle oracle({mesh});
    ASSERT_GT(oracle.edgeEdge().size(), 1000U);
    ElementCandidates candidates = candidatesOf({mesh});
    expectEqual(candidates, oracle);
  }
}

TEST(ElementCandidates, AreTheSameAtEveryDistanceAsTheDoubleLoops) {
  const MovingMesh mesh = rolledSheet(16, 3);
  const ElementOracle oracle({mesh});
  for (const double distance : {-0.3, 0.1, 1.0}) {
    ElementCandidates candidates = candidatesOf({mesh}, {.distance = distance});
    expectEqual(candidates, oracle, {.distance = distance});
  }
}

TEST(ElementCandidates, OfSeveralMeshesAreWithinOrBetweenThemAsIsWanted) {
  const std::vector<MovingMesh> meshes{rolledSheet(9, 4), shifted(rolledSheet(8, 5), 0.5, 0.25, 1.0), kTriangle};
  const ElementOracle oracle(meshes);
  for (const bool within : {false, true}) {
    for (const bool between : {false, true}) {
      ElementCandidates candidates = candidatesOf(meshes, {.withinMeshes = within, .betweenMeshes = between});
      expectEqual(candidates, oracle, {.within = within, .between = between});
    }
  }
}

TEST(ElementCandidates, WithoutOrderAndInParallelAreTheSame) {
  const MovingMesh mesh = rolledSheet(64, 6);
  parallel::TbbExecutor executor(4);
  for (const CandidateKind kind : {CandidateKind::VertexFace, CandidateKind::EdgeEdge, CandidateKind::FaceFace}) {
    ElementCandidates ordered = candidatesOf({mesh});
    const std::vector<Pair> expected = toVector(ordered.find(kind));
    ElementCandidates parallel = candidatesOf({mesh}, {.executor = &executor});
    EXPECT_EQ(toVector(parallel.find(kind)), expected);
    ElementCandidates unordered = candidatesOf({mesh}, {.order = Order::Unordered});
    std::vector<Pair> found = toVector(unordered.find(kind));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    EXPECT_EQ(ordered.count(kind), expected.size());
    std::vector<Pair> streamed;
    ordered.stream(kind,
                   [&](std::span<const Pair> batch) { streamed.insert(streamed.end(), batch.begin(), batch.end()); });
    EXPECT_EQ(streamed, expected);
  }
}

TEST(ElementCandidates, FollowTheirPositions) {
  MovingMesh mesh = rolledSheet(10, 7);
  ElementCandidates candidates = candidatesOf({mesh});
  expectEqual(candidates, ElementOracle({mesh}));
  mesh = rounded(rolledSheet(10, 8));
  const std::vector<float> start(mesh.start.begin(), mesh.start.end());
  const std::vector<float> end(mesh.end.begin(), mesh.end.end());
  candidates.setPositions(0, std::span<const float>(start), end);
  expectEqual(candidates, ElementOracle({mesh}));
}

TEST(ElementCandidates, FollowTheirPositionsWhereFloat32IsTooCoarse) {
  const double above = 1.0 + 0x1p-52;  // which float32 can't tell from 1
  const MovingMesh slope{{0, 0, 0, 1, 0, 0, 0, 1, 1}, {0, 0, 0, 1, 0, 0, 0, 1, 1}, {0, 1, 2}};
  const auto there = [&](double x) { return shifted(slope, x, 0.25, 0.25).start; };
  ElementCandidates candidates = candidatesOf({slope, shifted(slope, 0.75 + 0x1p-40, 0.25, 0.25)});
  EXPECT_EQ(candidates.find(CandidateKind::FaceFace).size(), 1U);
  for (const auto& [x, count] :
       {std::pair(above, 0U), {0.5 + 0x1p-40, 1U}, {above, 0U}, {3.0 + 0x1p-40, 0U}, {-0.5 - 0x1p-40, 1U}}) {
    const std::vector<double> positions = there(x);
    candidates.setPositions(1, std::span<const double>(positions), positions);
    EXPECT_EQ(candidates.find(CandidateKind::FaceFace).size(), count) << x;
  }
}

TEST(ElementCandidates, AreExactWhereOnlyLowerBoundsAreRounded) {
  const double above = 1.0 + 0x1p-52;  // float32 makes it 1, where the triangle ends
  const MovingMesh point{{above, above, above}, {4.0, 4.0, 4.0}, {}};
  const MovingMesh triangle{{1, 0, 0, 0, 0, 0, 1, 1, 0}, {1, 1, 1, 1, 1, 1, 1, 1, 1}, {0, 1, 2}};
  ElementCandidates candidates = candidatesOf({point, triangle});
  EXPECT_EQ(toVector(candidates.find(CandidateKind::VertexFace)), std::vector<Pair>());
  expectEqual(candidates, ElementOracle({point, triangle}));
}

TEST(ElementCandidates, AreStreamedInBatchesOfAtMostTheSizeThatIsWanted) {
  ElementCandidates candidates = candidatesOf({rolledSheet(10, 7)});
  const std::size_t all = candidates.find(CandidateKind::FaceFace).size();
  ASSERT_GT(all, 100U);
  for (const std::size_t most : {1U, 7U, 1000000U}) {
    std::size_t sum = 0;
    const auto take = [&](Span<const Pair> pairs) {
      EXPECT_LE(pairs.size(), most);
      sum += pairs.size();
    };
    candidates.stream(CandidateKind::FaceFace, take, most);
    EXPECT_EQ(sum, all);
  }
}

TEST(ElementCandidates, ThatOnlyTouchAreCandidates) {
  // The second triangle lies one further along x, where the first ends.
  ElementCandidates candidates = candidatesOf({kTriangle, shifted(kTriangle, 1.0, 0.0, 0.0)});
  EXPECT_EQ(toVector(candidates.find(CandidateKind::FaceFace)), (std::vector<Pair>{{0, 1}}));
  const double above = 1.0 + 0x1p-52;  // which float32 can't tell from 1
  ElementCandidates apart = candidatesOf({kTriangle, shifted(kTriangle, above, 0.0, 0.0)});
  EXPECT_EQ(toVector(apart.find(CandidateKind::FaceFace)), std::vector<Pair>());
}

TEST(ElementCandidates, AreExactWhereOnlyUpperBoundsAreRounded) {
  const double below = 1.0 - 0x1p-53;  // float32 makes it 1, where the triangle begins
  const double odd = 3.0 + 0x1p-40;
  const MovingMesh point{{0.0, 0.0, 0.0}, {below, below, below}, {}};
  const MovingMesh triangle{{1, 0, 0, 2, 0, 0, 1, 1, 0}, {odd, odd, odd, odd, odd, odd, odd, odd, odd}, {0, 1, 2}};
  ElementCandidates candidates = candidatesOf({point, triangle});
  EXPECT_EQ(toVector(candidates.find(CandidateKind::VertexFace)), std::vector<Pair>());
  expectEqual(candidates, ElementOracle({point, triangle}));
}

TEST(ElementCandidates, SeeWhatHappensBetweenStartAndEnd) {
  MovingMesh point{{0.25, 0.25, 5.0}, {0.25, 0.25, -5.0}, {}};
  ElementCandidates candidates = candidatesOf({kTriangle, point});
  EXPECT_EQ(toVector(candidates.find(CandidateKind::VertexFace)), (std::vector<Pair>{{3, 0}}));
}

TEST(ElementCandidates, OfNumbersBeyondFloat32AreExact) {
  MovingMesh mesh = kTriangle;
  for (std::vector<double>* positions : {&mesh.start, &mesh.end}) {
    for (double& x : *positions) x *= 1e300;
  }
  const std::vector<MovingMesh> meshes{mesh, shifted(mesh, 2e300, 0.0, 0.0), shifted(mesh, 1e300, 0.0, 0.0)};
  ElementCandidates candidates = candidatesOf(meshes);
  expectEqual(candidates, ElementOracle(meshes));
}

TEST(ElementCandidates, RefusePositionsOfTheWrongNumberNamingTheMesh) {
  MovingMesh mesh = kTriangle;
  mesh.end.resize(6);
  EXPECT_EQ(messageOf(mesh), "mesh 0: its positions at the end are 6 numbers where 3 vertices need 9");
  mesh.end.resize(12);
  EXPECT_EQ(messageOf(mesh), "mesh 0: its positions at the end are 12 numbers where 3 vertices need 9");
}

TEST(ElementCandidates, RefuseANumberThatIsNotFiniteNamingMeshAndVertex) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    MovingMesh mesh = kTriangle;
    mesh.start[7] = bad;
    EXPECT_EQ(messageOf(mesh), "mesh 0: vertex 2 has a coordinate at the start that is no finite number");
  }
}

TEST(ElementCandidates, RefuseAMeshThatIsNotThereAndADistanceThatIsNone) {
  ElementCandidates candidates = candidatesOf({kTriangle});
  EXPECT_THROW(candidates.setPositions(1, std::span<const double>(), {}), InvalidArgument);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double distance : {std::numeric_limits<double>::quiet_NaN(), -kInfinity}) {
    for (const bool within : {true, false}) {  // without, one mesh has no candidates, and nothing is searched
      EXPECT_THROW(candidatesOf({kTriangle}, {.distance = distance, .withinMeshes = within}), InvalidArgument);
    }
  }
}

TEST(ElementCandidates, RefuseBatchesOfNone) {
  for (const bool within : {true, false}) {
    ElementCandidates candidates = candidatesOf({kTriangle}, {.withinMeshes = within});
    EXPECT_THROW(candidates.stream(
                     CandidateKind::FaceFace, [](Span<const Pair>) {}, 0),
                 InvalidArgument);
  }
}

TEST(ElementCandidates, OfNoKindAreRefused) {
  ElementCandidates candidates = candidatesOf({kTriangle, kTriangle});
  const auto none = static_cast<CandidateKind>(3);
  EXPECT_THROW(static_cast<void>(candidates.find(none)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(candidates.count(none)), InvalidArgument);
  EXPECT_THROW(candidates.stream(none, [](Span<const Pair>) {}), InvalidArgument);
  EXPECT_EQ(candidates.find(CandidateKind::FaceFace).size(), 1U);
}

TEST(ElementCandidates, AreMadeWhileTheirSearchesAreStopped) {
  StopFlag stop;
  stop.set();
  ElementCandidates candidates = candidatesOf({kTriangle, kTriangle}, {.stop = &stop});
  EXPECT_THROW(static_cast<void>(candidates.find(CandidateKind::FaceFace)), Stopped);
  EXPECT_THROW(static_cast<void>(candidates.count(CandidateKind::EdgeEdge)), Stopped);
  stop.clear();
  EXPECT_EQ(candidates.find(CandidateKind::FaceFace).size(), 1U);
}

TEST(ElementCandidates, TakeOfMemoryOfTheCallersWhatTheyUse) {
  MovingMesh apart;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const MovingMesh triangle = shifted(kTriangle, 3.0 * i, 0, 0);
    apart.start.insert(apart.start.end(), triangle.start.begin(), triangle.start.end());
    apart.end.insert(apart.end.end(), triangle.end.begin(), triangle.end.end());
    apart.triangles.insert(apart.triangles.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  }
  std::vector<std::byte> bytes(std::size_t{8} << 20);
  std::pmr::monotonic_buffer_resource memory(bytes.data(), bytes.size(), std::pmr::null_memory_resource());
  ElementCandidates candidates = candidatesOf({apart}, {.memory = &memory});
  EXPECT_EQ(candidates.find(CandidateKind::FaceFace).size(), 0U);
  EXPECT_EQ(candidates.find(CandidateKind::EdgeEdge).size(), 0U);
}

}  // namespace
}  // namespace allpairs::elements
