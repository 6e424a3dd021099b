// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "Interrupts.h"
#include "allpairs/OverlapOptions.h"

namespace allpairs::python {

/// Whose side a filter's array is of.
enum class Side : std::uint8_t { First, Second };

/// The settings of a search, with the arrays that they refer to kept alive.
class Options {
 public:
  OverlapOptions engine;
  std::size_t threads = 1;  ///< 0: as many as the machine runs at once.

  /// Contiguous buffers of one uint32 for each box of that side.
  void setGroups(Side side, const pybind11::buffer& values);
  void setCategories(Side side, const pybind11::buffer& values);
  void setMasks(Side side, const pybind11::buffer& values);

  /// A contiguous buffer of shape (k, 2), uint32: pairs to leave out. For pairs of one set in either orientation.
  void setIgnored(const pybind11::buffer& pairs, bool oneSet);

  /// Settings for a search over that many boxes, with an executor if there is enough work.
  [[nodiscard]] OverlapOptions withExecutor(std::size_t boxes);

  /// Runs a search over that many boxes, search(settings), without the GIL, until it ends or a signal interrupts it.
  template <class Search>
  auto run(std::size_t boxes, const Search& search) {
    return interruptibly(boxes, Runs::Alone, [&](Stopper& stopper) {
      const Stopper::Hold hold(stopper, m_stop);
      OverlapOptions settings = withExecutor(boxes);
      settings.stop = &m_stop.flag();
      return search(settings);
    });
  }

 private:
  [[nodiscard]] FilterBits& bits(Side side) { return side == Side::First ? engine.filter.first : engine.filter.second; }
  [[nodiscard]] std::span<const std::uint32_t> hold(const pybind11::buffer& values);

  std::vector<std::unique_ptr<pybind11::buffer_info>> m_held;
  std::unique_ptr<Executor> m_executor;
  CallFlag m_stop;
};

}  // namespace allpairs::python
