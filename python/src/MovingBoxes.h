// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "Boxes.h"
#include "Gil.h"
#include "Interrupts.h"
#include "NumberArray.h"
#include "PairArray.h"
#include "allpairs/World.h"

namespace allpairs::python {

/// Properties of some boxes, from an array for each field.
class Properties {
 public:
  explicit Properties(std::size_t size) : m_values(size) {}

  /// Contiguous buffers with as many numbers as there are boxes.
  void setField(std::uint32_t BoxProperties::*field, const pybind11::buffer& values);
  void setMargins(const pybind11::buffer& values);
  void setStatic(const pybind11::buffer& values);

  [[nodiscard]] std::span<const BoxProperties> values() const noexcept { return m_values; }

  /// What a box that has had other properties has now: those fields that were set, and else what it had.
  [[nodiscard]] BoxProperties over(BoxProperties before, std::size_t box) const;

 private:
  std::vector<BoxProperties> m_values;
  std::vector<std::uint32_t BoxProperties::*> m_fields;  ///< Those that were set.
  bool m_hasMargins = false;
  bool m_hasStatic = false;
};

/// A World that Python may use from several threads, which wait for each other without the GIL.
class MovingBoxes {
 public:
  using Ids = std::unique_ptr<IdArray>;
  using Numbers = std::unique_ptr<RealArray>;

  MovingBoxes(double distance, Order order, std::size_t threads);

  [[nodiscard]] Ids add(const Boxes& boxes, const Properties& properties);
  void move(const pybind11::buffer& ids, const Boxes& boxes);
  void moveSwept(const pybind11::buffer& ids, const Boxes& starts, const Boxes& ends);
  void remove(const pybind11::buffer& ids);
  void clear();
  void setProperties(const pybind11::buffer& ids, const Properties& properties);

  /// Memory for that many boxes in all.
  void reserve(std::size_t boxes);
  void shrink();

  [[nodiscard]] std::size_t size();
  [[nodiscard]] bool contains(BoxId id);

  /// Of all boxes, ascending.
  [[nodiscard]] Ids ids();

  [[nodiscard]] Numbers boxes(const pybind11::buffer& ids);

  /// For each box a row of category, mask, group, whether it is static, and its world; and the margins.
  [[nodiscard]] pybind11::tuple properties(const pybind11::buffer& ids);

  /// All ids, and for each the box, and what properties() gives.
  [[nodiscard]] pybind11::tuple state();

  /// Pairs, and those that began, persisted and ended.
  [[nodiscard]] pybind11::tuple step();

  /// The same of the last step, for one world.
  [[nodiscard]] pybind11::tuple resultOf(std::uint32_t world);

  /// Of the last step.
  [[nodiscard]] WorldStatistics statistics();

  /// In each row the index of a query and the id of a box that it overlaps.
  [[nodiscard]] std::unique_ptr<PairArray> overlapping(const Boxes& boxes, const QueryFilter& filter);

  /// For each ray, of rows of 7 (origin, direction, length), the id of the first box that it meets, and t. With rows of
  /// 10 (box, direction, length), for each box that moves.
  [[nodiscard]] pybind11::tuple firstHits(const pybind11::buffer& sweeps, const QueryFilter& filter);

  /// The same of all boxes: where those of each ray begin, and one more; their ids; and t.
  [[nodiscard]] pybind11::tuple allHits(const pybind11::buffer& sweeps, const QueryFilter& filter);

  /// For each point, of rows of 3, or box, of rows of 6, the ids of the nearest boxes, and their distances; kNoBox and
  /// infinity at the end.
  [[nodiscard]] pybind11::tuple nearest(const pybind11::buffer& queries, std::size_t count, const QueryFilter& filter);

  /// Pairs of a box of this and one of another, or of this too.
  [[nodiscard]] std::unique_ptr<PairArray> between(MovingBoxes& other);

 private:
  [[nodiscard]] Runs runs() const noexcept { return m_executor ? Runs::OnThreads : Runs::Alone; }

  /// Runs work on the world without the GIL, alone.
  template <class Work>
  decltype(auto) alone(const Work& work) {
    const ReleasedGil released;
    const std::lock_guard lock(m_mutex);
    return work(m_world);
  }

  /// The same for a search, with as many boxes that it asks for, that a signal may interrupt.
  template <class Work>
  auto search(std::size_t queries, const Work& work) {
    return interruptibly(m_size + queries, runs(), [&](Stopper& stopper) {
      const std::lock_guard lock(m_mutex);
      const Stopper::Hold hold(stopper, m_stop);
      return work(m_world);
    });
  }

  std::mutex m_mutex;
  CallFlag m_stop;
  std::atomic<std::size_t> m_size = 0;
  std::uint64_t m_steps = 0;
  std::unique_ptr<Executor> m_executor;
  World m_world;
};

}  // namespace allpairs::python
