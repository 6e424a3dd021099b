// SPDX-License-Identifier: MIT
#include <mpi.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "Bindings.h"
#include "Boxes.h"
#include "Executors.h"
#include "Gil.h"
#include "IdPairArray.h"
#include "Options.h"
#include "allpairs/mpi/DistributedOverlaps.h"
#include "allpairs/mpi/OnAllRanks.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// A search over the communicator that has this handle in Fortran, which is a number in every MPI.
class DistributedSearch {
 public:
  DistributedSearch(MPI_Fint handle, const Options& options) {
    mpi::onAllRanks(MPI_Comm_f2c(handle), [&] { m_executor = executorOf(options.threads); });
    const OverlapOptions& given = options.engine;
    const mpi::DistributedOptions settings{.distance = given.distance,
                                           .region = given.region,
                                           .first = given.filter.first,
                                           .second = given.filter.second,
                                           .executor = m_executor.get(),
                                           .maxPairs = given.maxPairs};
    m_search.emplace(MPI_Comm_f2c(handle), settings);
  }

  [[nodiscard]] std::unique_ptr<IdPairArray> find(const Boxes& first, const Boxes* second) {
    const ReleasedGil released;
    return arrayOf(second != nullptr ? m_search->find(first.set(), second->set()) : m_search->find(first.set()));
  }

  [[nodiscard]] std::uint64_t count(const Boxes& first, const Boxes* second) {
    const ReleasedGil released;
    return second != nullptr ? m_search->count(first.set(), second->set()) : m_search->count(first.set());
  }

 private:
  std::unique_ptr<Executor> m_executor;
  std::optional<mpi::DistributedOverlaps> m_search;
};

std::string mpiVersion() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  return {text.data()};
}

}  // namespace
}  // namespace allpairs::python

PYBIND11_MODULE(_mpi, module) {
  using allpairs::python::DistributedSearch;
  namespace py = pybind11;
  module.doc() = "What allpairs.mpi is made of.";
  allpairs::python::bindErrors(module);
  py::module_::import("allpairs._core");  // has the types of arguments and results
  module.def("mpi_version", &allpairs::python::mpiVersion);
  py::class_<DistributedSearch>(module, "DistributedSearch")
      .def(py::init<MPI_Fint, const allpairs::python::Options&>(), py::keep_alive<1, 3>())
      .def("find", &DistributedSearch::find, py::arg("first"), py::arg("second") = nullptr)
      .def("count", &DistributedSearch::count, py::arg("first"), py::arg("second") = nullptr);
  allpairs::python::refusePickling(module);
}
