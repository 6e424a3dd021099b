// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "allpairs/Executor.h"
#include "allpairs/MemoryResource.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "allpairs/elements/MeshTopology.h"

namespace allpairs::elements {

/// Which two kinds of element make a candidate.
enum class CandidateKind : std::uint8_t {
  VertexFace,  ///< (vertex, triangle).
  EdgeEdge,    ///< (edge, edge), first < second.
  FaceFace,    ///< (triangle, triangle), first < second.
};

/// Which candidates are wanted, and how they are found; the defaults are right for one mesh that may fold onto itself.
struct CandidateOptions {
  /// Elements whose boxes are at most this far apart on every axis are candidates. Negative shrinks.
  double distance = 0.0;

  bool withinMeshes = true;   ///< Two elements of one mesh.
  bool betweenMeshes = true;  ///< Two elements of different meshes.

  Order order = Order::ByFirst;

  /// Where parallel work runs; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Where candidates and the memory of the search come from, as in OverlapOptions; the meshes and the boxes of their
  /// elements lie elsewhere. Null means aligned operator new. Not owned; must outlive the object.
  std::pmr::memory_resource* memory = nullptr;
};

/// Finds the pairs of elements of deforming triangle meshes that may touch during a step, for continuous collision
/// detection, and keeps its memory from one step to the next.
///
/// Geometry:  a vertex moves on a straight line from its start to its end, so the box of both holds it, and the box of an
///            element, which is that of its vertices at start and end, holds the element throughout. Boxes are closed and
///            compared exactly, in double. Two elements that have a vertex in common are no candidates.
/// Bad input: positions that are not finite or of the wrong number, a mesh that isn't there, and a distance that is NaN
///            or -infinity throw InvalidArgument that names mesh and vertex.
/// Cost:      of a search as in OverlapSearch; 48 bytes an element besides.
/// Threads:   one call at a time per object; parallel inside when the options name an executor.
/// Memory:    a call that throws, std::bad_alloc or what a visitor throws included, leaves all positions as they were;
///            the next search gives what a new object gives.
/// Callbacks: a visitor may use other objects; of the one that calls it, all but topology() throws InvalidArgument.
/// Moving:    an object that has been moved from is as a new one of no meshes.
class ElementCandidates {
 public:
  explicit ElementCandidates(MeshTopology topology, CandidateOptions options = {});
  ~ElementCandidates();
  ElementCandidates(ElementCandidates&&) noexcept;
  ElementCandidates& operator=(ElementCandidates&&) noexcept;

  /// Gives back the memory that is kept for the next search. Candidates that were found stay valid.
  void shrink();

  [[nodiscard]] const MeshTopology& topology() const noexcept;

  /// Says where the vertices of a mesh are at the start and at the end of the step, in rows of 3. Meshes that are not
  /// mentioned stay where they were; until set, all vertices are at the origin.
  void setPositions(std::size_t mesh, std::span<const float> start, std::span<const float> end);
  void setPositions(std::size_t mesh, std::span<const double> start, std::span<const double> end);

  /// All candidates of a kind, each once. Valid until the next search for the same kind.
  [[nodiscard]] std::span<const Pair> find(CandidateKind kind);

  /// How many find() would give, in memory that does not depend on it; on the calling thread.
  [[nodiscard]] std::uint64_t count(CandidateKind kind);

  /// Hands the candidates of find() to the visitor, in batches of at most `batchSize`, in memory that does not depend on
  /// their number.
  ///
  /// Bad input: a batch size of 0 throws InvalidArgument.
  void stream(CandidateKind kind, PairVisitor visitor, std::size_t batchSize = kBatchSize);

 private:
  struct State;
  State& state();
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::elements
