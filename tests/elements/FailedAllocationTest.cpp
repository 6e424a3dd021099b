// SPDX-License-Identifier: MIT
// Each allocation of ElementCandidates fails once, and its visitor throws and calls back.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/elements/ElementCandidates.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"

namespace allpairs::elements {
namespace {

constexpr CandidateKind kKinds[] = {CandidateKind::VertexFace, CandidateKind::EdgeEdge, CandidateKind::FaceFace};

/// A strip of triangles, wound up.
struct Strip {
  std::vector<double> start;
  std::vector<double> end;
  std::vector<std::uint32_t> triangles;

  Strip() {
    for (std::uint32_t i = 0; i < 240; ++i) {
      const double turn = 0.3 * i;
      const double radius = 1.0 + 0.01 * turn;
      start.insert(start.end(), {radius * std::cos(turn), radius * std::sin(turn), i % 2 == 0 ? 0.0 : 0.7});
      if (i > 1) triangles.insert(triangles.end(), {i - 2, i - 1, i});
    }
    for (const double x : start) end.push_back(x + 0.1);
  }

  [[nodiscard]] ElementCandidates candidates(const CandidateOptions& options = {}) const {
    return ElementCandidates(MeshTopology(MeshView{start.size() / 3, triangles}), options);
  }
};

using Lists = std::vector<std::vector<Pair>>;

Lists allOf(ElementCandidates& candidates) {
  Lists lists;
  for (const CandidateKind kind : kKinds) lists.push_back(test::toVector(candidates.find(kind)));
  return lists;
}

class FailedElementAllocation : public ::testing::TestWithParam<Order> {
 protected:
  Strip strip;
  CandidateOptions options;
  Lists before;  ///< Of the first positions,
  Lists after;   ///< and of others.

  FailedElementAllocation() {
    options.order = GetParam();
    ElementCandidates candidates = strip.candidates(options);
    candidates.setPositions(0, std::span<const double>(strip.start), strip.start);
    before = allOf(candidates);
    candidates.setPositions(0, std::span<const double>(strip.start), strip.end);
    after = allOf(candidates);
  }
};

INSTANTIATE_TEST_SUITE_P(OfEachOrder, FailedElementAllocation, ::testing::Values(Order::ByFirst, Order::Unordered));

TEST_P(FailedElementAllocation, LeavesSearchesUsable) {
  ASSERT_NE(before, after);
  for (const CandidateKind kind : kKinds) {
    const auto scene = [&](test::Fault& fault) {
      ElementCandidates candidates = strip.candidates(options);
      candidates.setPositions(0, std::span<const double>(strip.start), strip.start);
      static_cast<void>(fault.during([&] {
        static_cast<void>(candidates.find(kind));
        static_cast<void>(candidates.count(kind));
        candidates.stream(kind, [](std::span<const Pair>) {});
      }));
      ASSERT_EQ(allOf(candidates), before);
      candidates.setPositions(0, std::span<const double>(strip.start), strip.end);
      ASSERT_EQ(allOf(candidates), after);
    };
    test::failEachAllocation(scene);
  }
}

TEST_P(FailedElementAllocation, LeaksNothingWhileObjectsAreMade) {
  const auto scene = [&](test::Fault& fault) {
    static_cast<void>(fault.during([&] { static_cast<void>(strip.candidates(options)); }));
  };
  test::failEachAllocation(scene);
}

TEST_P(FailedElementAllocation, OfAVisitorIsThatOfTheSearch) {
  ElementCandidates candidates = strip.candidates(options);
  candidates.setPositions(0, std::span<const double>(strip.start), strip.end);
  const auto throwing = [](std::span<const Pair>) { throw std::runtime_error("enough"); };
  EXPECT_THROW(candidates.stream(CandidateKind::FaceFace, throwing), std::runtime_error);
  EXPECT_EQ(allOf(candidates), after);
}

TEST_P(FailedElementAllocation, AVisitorThatCallsItsObjectIsRefused) {
  ElementCandidates candidates = strip.candidates(options);
  ElementCandidates others = strip.candidates(options);
  candidates.setPositions(0, std::span<const double>(strip.start), strip.end);
  others.setPositions(0, std::span<const double>(strip.start), strip.end);
  std::size_t calls = 0;
  candidates.stream(CandidateKind::FaceFace, [&](std::span<const Pair>) {
    ++calls;
    EXPECT_THROW(static_cast<void>(candidates.find(CandidateKind::EdgeEdge)), InvalidArgument);
    EXPECT_THROW(static_cast<void>(candidates.count(CandidateKind::EdgeEdge)), InvalidArgument);
    EXPECT_THROW(candidates.stream(CandidateKind::EdgeEdge, [](std::span<const Pair>) {}), InvalidArgument);
    EXPECT_THROW(candidates.setPositions(0, std::span<const double>(strip.end), strip.end), InvalidArgument);
    EXPECT_EQ(candidates.topology().meshCount(), 1U);
    EXPECT_EQ(allOf(others), after);
  });
  EXPECT_GT(calls, 0U);
  EXPECT_EQ(allOf(candidates), after);
}

TEST(MovedFromElements, AreAsOfNoMeshes) {
  const Strip strip;
  ElementCandidates first = strip.candidates();
  const ElementCandidates second(std::move(first));
  EXPECT_EQ(second.topology().meshCount(), 1U);
  // NOLINTBEGIN(bugprone-use-after-move): what is tested
  EXPECT_EQ(first.topology().meshCount(), 0U);
  EXPECT_EQ(first.topology().counts(), ElementCounts{});
  EXPECT_TRUE(first.find(CandidateKind::EdgeEdge).empty());
  EXPECT_EQ(first.count(CandidateKind::VertexFace), 0U);
  EXPECT_THROW(first.setPositions(0, std::span<const double>(), {}), InvalidArgument);
  MeshTopology topology(MeshView{strip.start.size() / 3, strip.triangles});
  const MeshTopology moved(std::move(topology));
  EXPECT_EQ(topology.meshCount(), 0U);
  EXPECT_EQ(topology.before(0), ElementCounts{});
  EXPECT_THROW(static_cast<void>(topology.before(1)), InvalidArgument);
  EXPECT_TRUE(topology.edges().empty());
  // NOLINTEND(bugprone-use-after-move)
}

}  // namespace
}  // namespace allpairs::elements
