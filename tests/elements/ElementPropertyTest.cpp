// SPDX-License-Identifier: MIT
// Meshes without any sense, whose vertices coincide, align and nearly do, against the double loop. RapidCheck prints
// the seed and the smallest failing case.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "ElementOracle.h"
#include "allpairs/elements/ElementCandidates.h"
#include "support/Boxes.h"

namespace allpairs::elements {
namespace {

using test::MovingMesh;

/// Few values, some of which float32 can't tell apart.
rc::Gen<double> coordinate() {
  return rc::gen::weightedOneOf<double>(
      {{6, rc::gen::map(rc::gen::inRange(-4, 5), [](int i) { return 0.5 * i; })},
       {2, rc::gen::map(rc::gen::inRange(-20, 21), [](int i) { return 1.0 + i * 0x1p-52; })},
       {1, rc::gen::map(rc::gen::inRange(-20, 21), [](int i) { return i * 0x1p-1074; })},
       {1, rc::gen::element(-0.0, 1e-45, 3.4e38, 3.5e38, -1e300, 1e300)}});
}

MovingMesh anyMesh() {
  const auto vertices = *rc::gen::inRange<std::size_t>(1, 24);
  const auto triangles = *rc::gen::inRange<std::size_t>(0, 40);
  MovingMesh mesh;
  mesh.start = *rc::gen::container<std::vector<double>>(3 * vertices, coordinate());
  mesh.end = *rc::gen::container<std::vector<double>>(3 * vertices, coordinate());
  mesh.triangles = *rc::gen::container<std::vector<std::uint32_t>>(
      3 * triangles, rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(vertices)));
  return mesh;
}

RC_GTEST_PROP(ElementProperty, AnyMeshesAtAnyDistanceGiveTheOraclesCandidates, ()) {
  std::vector<MovingMesh> meshes{anyMesh()};
  if (*rc::gen::arbitrary<bool>()) meshes.push_back(anyMesh());
  const double distance = *rc::gen::weightedElement<double>({{4, 0.0}, {1, 0.5}, {1, 0.1}, {1, -0.5}, {1, 0x1p-52}});
  const bool within = *rc::gen::weightedElement<bool>({{3, true}, {1, false}});
  const bool between = *rc::gen::weightedElement<bool>({{3, true}, {1, false}});
  const test::ElementOracle oracle(meshes);
  ElementCandidates candidates =
      test::candidatesOf(meshes, {.distance = distance, .withinMeshes = within, .betweenMeshes = between});
  const test::Wanted wanted{distance, within, between};
  RC_ASSERT(test::toVector(candidates.find(CandidateKind::VertexFace)) == oracle.vertexFace(wanted));
  RC_ASSERT(test::toVector(candidates.find(CandidateKind::EdgeEdge)) == oracle.edgeEdge(wanted));
  RC_ASSERT(test::toVector(candidates.find(CandidateKind::FaceFace)) == oracle.faceFace(wanted));
}

}  // namespace
}  // namespace allpairs::elements
