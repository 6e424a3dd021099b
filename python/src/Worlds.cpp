// SPDX-License-Identifier: MIT
#include "allpairs/Worlds.h"

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "Arguments.h"
#include "Bindings.h"
#include "Boxes.h"
#include "BufferProtocol.h"
#include "NumberArray.h"
#include "Options.h"
#include "PairArray.h"
#include "allpairs/Error.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// How boxes are divided, with the arrays that say so kept alive.
class Division {
 public:
  /// Offsets are a contiguous buffer of uint64, ignored pairs one of shape (k, 2), uint32.
  Division(std::shared_ptr<Boxes> boxes, const py::buffer& begin, const py::buffer& ignored)
      : m_boxes(std::move(boxes)), m_begin(begin.request()), m_ignored(requestBuffer(ignored, {"I", 2})) {
    if (m_begin.ndim != 1 || m_begin.itemsize != 8 || (m_begin.format != "L" && m_begin.format != "Q")) {
      throw InvalidArgument("offsets of another kind than the module takes");
    }
    m_worlds = Worlds(m_boxes->set(), valuesOf<std::uint64_t>(m_begin));
    const std::span<const std::uint32_t> numbers = valuesOf<std::uint32_t>(m_ignored);
    m_worlds.setIgnoredPairs({reinterpret_cast<const Pair*>(numbers.data()), numbers.size() / 2});
  }

  [[nodiscard]] const Worlds& worlds() const noexcept { return m_worlds; }

 private:
  std::shared_ptr<Boxes> m_boxes;
  py::buffer_info m_begin;
  py::buffer_info m_ignored;
  Worlds m_worlds;
};

py::tuple toTuple(WorldPairs found) {
  return py::make_tuple(toPython(std::move(found.pairs)), arrayOf(std::move(found.begin)));
}

std::size_t boxesOf(const Worlds& worlds, const Boxes* shared) {
  return worlds.boxes().size() + (shared == nullptr ? 0 : shared->set().size());
}

py::tuple findInWorlds(const Division& division, const Boxes* shared, Options& options) {
  const Worlds& worlds = division.worlds();
  return toTuple(options.run(boxesOf(worlds, shared), [&](const OverlapOptions& settings) {
    return shared == nullptr ? overlapsInWorlds(worlds, settings) : overlapsInWorlds(worlds, shared->set(), settings);
  }));
}

std::unique_ptr<OffsetArray> countInWorlds(const Division& division, const Boxes* shared, Options& options) {
  const Worlds& worlds = division.worlds();
  return arrayOf(options.run(boxesOf(worlds, shared), [&](const OverlapOptions& settings) {
    return shared == nullptr ? countOverlapsInWorlds(worlds, settings)
                             : countOverlapsInWorlds(worlds, shared->set(), settings);
  }));
}

}  // namespace

void bindWorlds(py::module_& module) {
  const py::class_<OffsetArray> offsets(module, "OffsetArray", tableProtocol<OffsetArray>());
  py::class_<Division>(module, "Worlds").def(py::init<std::shared_ptr<Boxes>, const py::buffer&, const py::buffer&>());
  module.def("overlaps_in_worlds", &findInWorlds);
  module.def("count_in_worlds", &countInWorlds);
}

}  // namespace allpairs::python
