// SPDX-License-Identifier: MIT
#include "Batches.h"

#include <utility>

namespace allpairs::python {
namespace py = pybind11;

Batches::Batches(std::shared_ptr<Boxes> first, std::shared_ptr<Boxes> second, std::shared_ptr<Options> options,
                 std::size_t batchSize)
    : m_first(std::move(first)), m_second(std::move(second)), m_options(std::move(options)) {
  m_stream = std::make_unique<BatchStream>([this, batchSize](PairVisitor visitor) {
    const BoxView& boxes = m_first->set();
    if (m_second) {
      const BoxView& others = m_second->set();
      streamOverlaps(boxes, others, visitor, m_options->withExecutor(boxes.size() + others.size()), batchSize);
    } else {
      streamOverlaps(boxes, visitor, m_options->withExecutor(boxes.size()), batchSize);
    }
  });
}

Batches::~Batches() { close(); }

std::unique_ptr<PairArray> Batches::next() {
  std::optional<std::vector<Pair>> batch;
  {
    const py::gil_scoped_release release;
    batch = m_stream->next();
  }
  if (!batch) return nullptr;
  return toPython(std::move(*batch));
}

void Batches::close() {
  const py::gil_scoped_release release;
  m_stream->close();
}

}  // namespace allpairs::python
