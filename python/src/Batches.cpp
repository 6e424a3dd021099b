// SPDX-License-Identifier: MIT
#include "Batches.h"

#include <utility>

#include "Interrupts.h"

namespace allpairs::python {
namespace py = pybind11;

Batches::Batches(std::shared_ptr<Boxes> first, std::shared_ptr<Boxes> second, std::shared_ptr<Options> options,
                 std::size_t batchSize)
    : m_first(std::move(first)), m_second(std::move(second)), m_options(std::move(options)) {
  m_stream = std::make_unique<BatchStream>([this, batchSize](PairVisitor visitor, const StopFlag& stop) {
    const BoxView& boxes = m_first->set();
    OverlapOptions settings = m_options->withExecutor(boxes.size() + (m_second ? m_second->set().size() : 0));
    settings.stop = &stop;
    if (m_second) {
      streamOverlaps(boxes, m_second->set(), visitor, settings, batchSize);
    } else {
      streamOverlaps(boxes, visitor, settings, batchSize);
    }
  });
}

Batches::~Batches() { close(); }

bool Batches::isSoonReady() {
  const py::gil_scoped_release release;
  return m_stream->isSoonReady(kBetweenLooks);
}

std::unique_ptr<PairArray> Batches::next() {
  while (!isSoonReady()) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  std::optional<std::vector<Pair>> batch = m_stream->next();
  if (!batch) return nullptr;
  return toPython(std::move(*batch));
}

void Batches::close() {
  const py::gil_scoped_release release;
  m_stream->close();
}

}  // namespace allpairs::python
