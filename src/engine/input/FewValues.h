// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "allpairs/BoxView.h"
#include "allpairs/Executor.h"
#include "allpairs/OverlapOptions.h"
#include "input/Options.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// Float64 boxes whose bounds take few values, as in lattices, told in float32. Many of them touch at bounds that are
/// equal and no float32: then most hits are in doubt, and the exact test of these takes longer than all else.
///
/// Only which bounds are less, equal or greater decides about a pair. So each value of an axis gets a float32 of its
/// own, in the same order and about the same proportions; the boxes of these have the same pairs.
///
/// Cost: of other boxes a sample is read; of these all twice, on one thread and then on all, and 24 bytes a box.
class FewValues {
 public:
  explicit FewValues(std::pmr::memory_resource* memory)
      : m_values{Values(memory), Values(memory), Values(memory)}, m_rows(memory) {}

  /// The sets in float32, until the next call, or as they are: if they have float32 bounds already, or many values, or
  /// more than the order of bounds matters.
  const Sets& of(const Sets& sets, const OverlapOptions& options, Executor& executor);

  /// Releases all memory.
  void release() noexcept;

 private:
  /// The values of an axis, and what becomes of each: a hash table with linear probing.
  class Values {
   public:
    explicit Values(std::pmr::memory_resource* memory) : m_slots(memory), m_sorted(memory) {}

    /// Forgets all; from now on holds at most so many.
    void start(std::size_t most);

    /// Returns whether there is room for the value, if it is not there, near the place that it hashes to.
    bool add(double value);

    /// Sorts the values; returns the difference of the least and the greatest that are finite, halved: it may be more
    /// than any double.
    double sort();

    /// Gives each value its float32: the least finite one becomes 1, what is `span` greater 2, so that all are in normal
    /// range; infinities become the least and the greatest.
    void assign(double span);

    /// Of a value that was added.
    [[nodiscard]] float of(double value) const noexcept { return slot(value)->image; }

    void release() noexcept;

   private:
    struct Slot {
      double value;
      float image;
      bool isTaken;
    };

    [[nodiscard]] Slot* slot(double value) const noexcept;
    [[nodiscard]] std::span<double> finite() const noexcept;

    Buffer<Slot> m_slots;
    Buffer<double> m_sorted;
    std::size_t m_size = 0;
    std::size_t m_most = 0;
    unsigned m_bits = 0;  ///< There are 2^bits slots.
  };

  bool addAll(const BoxView& boxes, const OverlapOptions& options);
  BoxView convert(const BoxView& boxes, float* rows, Executor& executor) const;

  std::array<Values, 3> m_values;
  Buffer<float> m_rows;
  BoxView m_first;
  BoxView m_second;
  std::optional<Sets> m_sets;
};

}  // namespace allpairs::engine
