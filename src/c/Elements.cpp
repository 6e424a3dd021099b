// SPDX-License-Identifier: MIT
#include "Handles.h"
#include "allpairs/elements/ElementCandidates.h"

// NOLINTBEGIN(readability-identifier-naming): names are C's.

struct allpairs_elements {
  std::unique_ptr<allpairs::c::CallerMemory> memory;
  std::unique_ptr<allpairs::Executor> executor;
  std::unique_ptr<allpairs::c::CallerStop> stop;
  allpairs::elements::ElementCandidates candidates;
};

// NOLINTEND(readability-identifier-naming)

namespace allpairs::c {
namespace {

using elements::CandidateKind;
using elements::CandidateOptions;
using elements::ElementCandidates;
using elements::MeshTopology;

static_assert(sizeof(elements::Edge) == sizeof(allpairs_pair) && alignof(elements::Edge) == alignof(allpairs_pair));

CandidateKind kindOf(int kind) {
  switch (kind) {
    case ALLPAIRS_VERTEX_FACE:
      return CandidateKind::VertexFace;
    case ALLPAIRS_EDGE_EDGE:
      return CandidateKind::EdgeEdge;
    case ALLPAIRS_FACE_FACE:
      return CandidateKind::FaceFace;
  }
  throw InvalidArgument("no kind of candidates " + std::to_string(kind));
}

/// All but what the handle owns.
CandidateOptions optionsOf(const allpairs_elements_options& given) {
  CandidateOptions options;
  options.distance = given.distance;
  options.withinMeshes = !given.skip_within;
  options.betweenMeshes = !given.skip_between;
  options.order = orderOf(numberIn(given.order));
  return options;
}

MeshTopology topologyOf(std::span<const allpairs_mesh> meshes) {
  std::vector<elements::MeshView> views;
  views.reserve(meshes.size());
  for (const allpairs_mesh& mesh : meshes) {
    constexpr std::size_t kMost = UINT32_MAX;  // also keeps the product below from wrapping
    if (mesh.triangle_count > kMost) {
      throw InvalidArgument("a mesh of " + std::to_string(mesh.triangle_count) + " triangles");
    }
    views.push_back({mesh.vertex_count, requiredSpan(mesh.triangles, 3 * mesh.triangle_count, "triangles")});
  }
  return MeshTopology(views);
}

ElementCandidates& candidatesOf(allpairs_elements* elements) { return required(elements, "elements").candidates; }

template <class T>
allpairs_status move(allpairs_elements* elements, std::size_t mesh, const T* start, const T* end) noexcept {
  return guarded([&] {
    ElementCandidates& candidates = candidatesOf(elements);
    const std::size_t numbers = 3 * candidates.topology().vertexCount(mesh);
    candidates.setPositions(mesh, requiredSpan(start, numbers, "start"), requiredSpan(end, numbers, "end"));
  });
}

}  // namespace
}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_elements_create(const allpairs_mesh* meshes, size_t count,
                                         const allpairs_elements_options* options, allpairs_elements** elements) {
  return guarded([&] {
    allpairs_elements*& result = required(elements, "elements");
    const allpairs_elements_options given = known(options);
    std::unique_ptr<allpairs::Executor> executor = executorFor(given.threads);
    std::unique_ptr<CallerMemory> memory = memoryOf(given.memory);
    std::unique_ptr<CallerStop> stop = stopOf(given);
    allpairs::elements::CandidateOptions settings = optionsOf(given);
    settings.executor = executor.get();
    settings.memory = memory.get();
    settings.stop = flagOf(stop);
    allpairs::elements::ElementCandidates made(topologyOf(requiredSpan(meshes, count, "meshes")), settings);
    allpairs_elements handle{std::move(memory), std::move(executor), std::move(stop), std::move(made)};
    result = std::make_unique<allpairs_elements>(std::move(handle)).release();
  });
}

void allpairs_elements_destroy(allpairs_elements* elements) {
  delete elements;  // NOLINT(cppcoreguidelines-owning-memory): C's handle
}

allpairs_status allpairs_elements_shrink(allpairs_elements* elements) {
  return guarded([&] { candidatesOf(elements).shrink(); });
}

allpairs_status allpairs_elements_before(const allpairs_elements* elements, size_t mesh,
                                         allpairs_element_counts* counts) {
  return guarded([&] {
    const auto& before = required(elements, "elements").candidates.topology().before(mesh);
    required(counts, "counts") = {before.vertices, before.edges, before.triangles};
  });
}

allpairs_status allpairs_elements_edges(const allpairs_elements* elements, allpairs_pairs* edges) {
  return guarded([&] {
    const auto found = required(elements, "elements").candidates.topology().edges();
    required(edges, "edges") = {reinterpret_cast<const allpairs_pair*>(found.data()), found.size()};
  });
}

allpairs_status allpairs_elements_move_f32(allpairs_elements* elements, size_t mesh, const float* start,
                                           const float* end) {
  return move(elements, mesh, start, end);
}

allpairs_status allpairs_elements_move_f64(allpairs_elements* elements, size_t mesh, const double* start,
                                           const double* end) {
  return move(elements, mesh, start, end);
}

allpairs_status allpairs_elements_find(allpairs_elements* elements, allpairs_candidates kind, allpairs_pairs* pairs) {
  return guarded([&] {
    allpairs_pairs& result = required(pairs, "pairs");
    result = toC(candidatesOf(elements).find(kindOf(numberIn(kind))));
  });
}

allpairs_status allpairs_elements_count(allpairs_elements* elements, allpairs_candidates kind, uint64_t* count) {
  return guarded([&] {
    std::uint64_t& result = required(count, "count");
    result = candidatesOf(elements).count(kindOf(numberIn(kind)));
  });
}

allpairs_status allpairs_elements_stream(allpairs_elements* elements, allpairs_candidates kind,
                                         allpairs_visitor visitor) {
  return guarded([&] {
    Visitor asking(visitor);
    candidatesOf(elements).stream(kindOf(numberIn(kind)), asking, asking.batchSize());
  });
}

// NOLINTEND(readability-identifier-naming)
