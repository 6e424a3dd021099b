// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "BatchStream.h"
#include "Boxes.h"
#include "Options.h"
#include "PairArray.h"

namespace allpairs::python {

/// The batches of one search, for Python to fetch; keeps what the search reads alive.
class Batches {
 public:
  /// `second` is null for pairs of one set.
  Batches(std::shared_ptr<Boxes> first, std::shared_ptr<Boxes> second, std::shared_ptr<Options> options,
          std::size_t batchSize);
  Batches(const Batches&) = delete;
  Batches& operator=(const Batches&) = delete;
  ~Batches();

  /// Null after the last batch. Signals are handled while it waits.
  [[nodiscard]] std::unique_ptr<PairArray> next();
  void close();

 private:
  [[nodiscard]] bool isSoonReady();

  std::shared_ptr<Boxes> m_first;
  std::shared_ptr<Boxes> m_second;
  std::shared_ptr<Options> m_options;
  std::unique_ptr<BatchStream> m_stream;
  int m_process;  ///< Which has the thread that searches.
};

}  // namespace allpairs::python
