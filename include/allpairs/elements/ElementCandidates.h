// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "allpairs/Executor.h"
#include "allpairs/MemoryResource.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "allpairs/Span.h"
#include "allpairs/elements/MeshTopology.h"

namespace allpairs::elements {

/// The two kinds of element in a candidate.
enum class CandidateKind : std::uint8_t {
  VertexFace,  ///< (vertex, triangle).
  EdgeEdge,    ///< (edge, edge), first < second.
  FaceFace,    ///< (triangle, triangle), first < second.
};

/// Which candidates to find, and how; the defaults suit a single mesh that may fold onto itself.
struct CandidateOptions {
  /// Elements whose boxes are at most this far apart on every axis are candidates. Negative requires that much overlap.
  double distance = 0.0;

  bool withinMeshes = true;   ///< Pairs of elements of one mesh.
  bool betweenMeshes = true;  ///< Pairs of elements of different meshes.

  Order order = Order::ByFirst;

  /// Runs parallel work; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Allocates candidates and the memory of the search, as in OverlapOptions; the meshes and the boxes of their
  /// elements are allocated elsewhere. Null means aligned operator new. Not owned; must outlive the object.
  std::pmr::memory_resource* memory = nullptr;

  /// If given, a search throws Stopped soon after this is set. Not owned.
  const StopFlag* stop = nullptr;
};

/// Finds the pairs of elements of deforming triangle meshes that may touch during a step, for continuous collision
/// detection, and keeps its memory between steps.
///
/// Geometry:  a vertex moves on a straight line from its start to its end. The box of an element bounds its vertices at
///            start and end, and hence the element during the whole step. Boxes are closed and compared exactly, in
///            double. Two elements that share a vertex are never candidates.
/// Bad input: positions that are not finite or of the wrong number, a mesh out of range, and a distance that is NaN
///            or -infinity throw InvalidArgument, which names mesh and vertex. So does a CandidateKind that is
///            none, cast from a number.
/// Cost:      that of a search as in OverlapSearch, plus 48 bytes for the boxes of an element, or about 110 where
///            float32 cannot represent its positions. Most of what is reserved of default memory is never touched.
/// Threads:   one call at a time per object; parallel inside if the options have an executor.
/// Memory:    a call that throws, whether std::bad_alloc or an exception of a visitor, leaves all positions unchanged;
///            the next search behaves like that of a new object.
/// Callbacks: a visitor may use other objects; on the object that calls it, all members except topology() throw
///            InvalidArgument.
/// Moving:    a moved-from object is like a new one without meshes.
class ElementCandidates {
 public:
  explicit ElementCandidates(MeshTopology topology, CandidateOptions options = {});
  ~ElementCandidates();
  ElementCandidates(ElementCandidates&&) noexcept;
  ElementCandidates& operator=(ElementCandidates&&) noexcept;

  /// Releases the memory kept for the next search. The candidates found last stay valid.
  void shrink();

  [[nodiscard]] const MeshTopology& topology() const noexcept;

  /// Sets the positions of the vertices of a mesh at the start and at the end of the step, in rows of 3. Other meshes
  /// keep their positions; until set, all vertices are at the origin.
  void setPositions(std::size_t mesh, Span<const float> start, Span<const float> end);
  void setPositions(std::size_t mesh, Span<const double> start, Span<const double> end);

  /// All candidates of a kind, each once. Valid until the next search for the same kind.
  [[nodiscard]] Span<const Pair> find(CandidateKind kind);

  /// The number of candidates of find(), on the calling thread; uses memory independent of that number.
  [[nodiscard]] std::uint64_t count(CandidateKind kind);

  /// Passes the candidates of find() to the visitor, in batches of at most `batchSize`; uses memory independent of
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
