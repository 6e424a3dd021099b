// SPDX-License-Identifier: MIT
#include "Batches.h"

#ifndef _WIN32
#include <unistd.h>
#endif

#include <utility>

#include "Gil.h"
#include "Interrupts.h"
#include "allpairs/Error.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

int processNumber() {
#ifdef _WIN32
  return 0;  // no process is forked from another
#else
  return ::getpid();
#endif
}

}  // namespace

Batches::Batches(std::shared_ptr<Boxes> first, std::shared_ptr<Boxes> second, std::shared_ptr<Options> options,
                 std::size_t batchSize)
    : m_first(std::move(first)),
      m_second(std::move(second)),
      m_options(std::move(options)),
      m_process(processNumber()) {
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
  const ReleasedGil released;
  return m_stream->isSoonReady(kBetweenLooks);
}

std::unique_ptr<PairArray> Batches::next() {
  if (processNumber() != m_process) {
    throw InvalidArgument("the thread that finds the pairs is that of the process that this one was forked from");
  }
  while (!isSoonReady()) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  std::optional<std::vector<Pair>> batch = m_stream->next();
  if (!batch) return nullptr;
  return toPython(std::move(*batch));
}

void Batches::close() {
  if (processNumber() != m_process)
    return static_cast<void>(m_stream.release());  // there is no thread that could be ended
  const ReleasedGil released;
  m_stream->close();
}

}  // namespace allpairs::python
