// SPDX-License-Identifier: MIT
// Candidates of deforming triangle meshes.
#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "Arguments.h"
#include "Bindings.h"
#include "Executors.h"
#include "Gil.h"
#include "Interrupts.h"
#include "NumberArray.h"
#include "PairArray.h"
#include "allpairs/Error.h"
#include "allpairs/elements/ElementCandidates.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

using elements::CandidateKind;

/// What a search for candidates is told before it starts.
struct CandidateSettings {
  double distance = 0.0;
  bool within = true;
  bool between = true;
  Order order = Order::ByFirst;
  std::size_t threads = 1;
};

/// Rows of indices as one array of numbers.
template <class Rows>
std::vector<std::uint32_t> flat(const Rows& rows) {
  std::vector<std::uint32_t> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

/// ElementCandidates that Python may use from several threads, which wait for each other without the GIL.
class MeshCandidates {
 public:
  /// A buffer of triangles, (k, 3), for each mesh, and how many vertices each has.
  MeshCandidates(const std::vector<py::buffer>& triangles, const std::vector<std::size_t>& vertexCounts,
                 const CandidateSettings& settings)
      : m_executor(executorOf(settings.threads)),
        m_candidates(topologyOf(triangles, vertexCounts), {.distance = settings.distance,
                                                           .withinMeshes = settings.within,
                                                           .betweenMeshes = settings.between,
                                                           .order = settings.order,
                                                           .executor = m_executor.get(),
                                                           .stop = &m_stop.flag()}) {}

  /// Contiguous buffers of shape (n, 3), both float32 or both float64.
  void setPositions(std::size_t mesh, const py::buffer& start, const py::buffer& end) {
    const bool single = isFloat32(start);
    const py::buffer_info from = requestBuffer(start, {single ? "f" : "d", 3});
    const py::buffer_info to = requestBuffer(end, {single ? "f" : "d", 3});
    const ReleasedGil released;
    const std::lock_guard lock(m_mutex);
    if (single) {
      m_candidates.setPositions(mesh, valuesOf<float>(from), valuesOf<float>(to));
    } else {
      m_candidates.setPositions(mesh, valuesOf<double>(from), valuesOf<double>(to));
    }
  }

 private:
  /// Runs a search without the GIL, alone, until it ends or a signal interrupts it.
  template <class Work>
  auto search(const Work& work) {
    const Runs runs = m_executor ? Runs::OnThreads : Runs::Alone;
    return interruptibly(m_candidates.topology().edges().size(), runs, [&](Stopper& stopper) {
      const std::lock_guard lock(m_mutex);
      const Stopper::Hold hold(stopper, m_stop);
      return work(m_candidates);
    });
  }

 public:
  [[nodiscard]] std::unique_ptr<PairArray> find(CandidateKind kind) {
    return search([kind](elements::ElementCandidates& candidates) {
      const std::span<const Pair> pairs = candidates.find(kind);
      return toPython({pairs.begin(), pairs.end()});
    });
  }

  [[nodiscard]] std::uint64_t count(CandidateKind kind) {
    return search([kind](elements::ElementCandidates& candidates) { return candidates.count(kind); });
  }

  void shrink() {
    const ReleasedGil released;
    const std::lock_guard lock(m_mutex);
    m_candidates.shrink();
  }

  [[nodiscard]] std::unique_ptr<IdArray> edges() const { return arrayOf(flat(m_candidates.topology().edges()), 2); }

  [[nodiscard]] std::unique_ptr<IdArray> triangles() const {
    return arrayOf(flat(m_candidates.topology().triangles()), 3);
  }

 private:
  static elements::MeshTopology topologyOf(const std::vector<py::buffer>& triangles,
                                           const std::vector<std::size_t>& vertexCounts) {
    if (triangles.size() != vertexCounts.size()) throw InvalidArgument("as many vertex counts as meshes");
    std::vector<py::buffer_info> held;
    std::vector<elements::MeshView> meshes;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      held.push_back(requestBuffer(triangles[i], {"I", 3}));
      meshes.push_back({vertexCounts[i], valuesOf<std::uint32_t>(held.back())});
    }
    const ReleasedGil released;
    return elements::MeshTopology(std::span<const elements::MeshView>(meshes));
  }

  std::mutex m_mutex;
  CallFlag m_stop;
  std::unique_ptr<Executor> m_executor;
  elements::ElementCandidates m_candidates;
};

}  // namespace

void bindElements(py::module_& module) {
  py::enum_<CandidateKind>(module, "CandidateKind")
      .value("vertex_face", CandidateKind::VertexFace)
      .value("edge_edge", CandidateKind::EdgeEdge)
      .value("face_face", CandidateKind::FaceFace);
  py::class_<CandidateSettings>(module, "CandidateSettings")
      .def(py::init<>())
      .def_readwrite("distance", &CandidateSettings::distance)
      .def_readwrite("within", &CandidateSettings::within)
      .def_readwrite("between", &CandidateSettings::between)
      .def_readwrite("order", &CandidateSettings::order)
      .def_readwrite("threads", &CandidateSettings::threads);
  py::class_<MeshCandidates>(module, "MeshCandidates")
      .def(py::init<const std::vector<py::buffer>&, const std::vector<std::size_t>&, const CandidateSettings&>())
      .def("set_positions", &MeshCandidates::setPositions)
      .def("find", &MeshCandidates::find)
      .def("count", &MeshCandidates::count)
      .def("shrink", &MeshCandidates::shrink)
      .def("edges", &MeshCandidates::edges)
      .def("triangles", &MeshCandidates::triangles);
}

}  // namespace allpairs::python
