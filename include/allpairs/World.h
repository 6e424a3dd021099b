// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/Pair.h"
#include "allpairs/WorldTypes.h"

namespace allpairs {

/// Boxes that move: their overlapping pairs step by step, and queries against them.
///
/// Boxes are added, moved and removed by ids, one or many at a time. step() gives the pairs of all boxes as they are then
/// and what has changed since the step before. The order of the boxes in memory is kept from step to step, so that a
/// step costs what has changed: docs/decisions/0007 says how, and when the order is made anew.
///
/// Geometry:  as in OverlapSearch: boxes are closed; empty boxes overlap nothing; infinite bounds are allowed. Bounds given in
///            float64 are exact. A margin is part of a pair's distance, and in queries widens the box itself.
/// Ids:       those of removed boxes are given to others, after the step that tells that their pairs have ended, so that
///            within the lists of a step an id means one box. Ids of fresh boxes are consecutive.
/// Bad input: a box with a NaN, or an id that is not in the world, throws InvalidBox, whose index() is the place in the
///            batch and whose message names the id; nothing of the batch has then been done. Spans of different lengths,
///            and a view of boxes that carries margins, throw InvalidArgument: here a margin is a property.
/// Cost:      up to 200 bytes a box and 70 a pair. In a steady state, on the calling thread, nothing is allocated.
/// Threads:   const members may be called from several threads at once, queries included, while no other member is; all
///            others one at a time. Parallel inside when the options name an executor. Results never depend on threads or
///            the instruction set.
/// Memory:    a call that throws, std::bad_alloc or what `accept` throws included, leaves all boxes as they were: a batch
///            is done as a whole or not at all. After a step() that threw, result() has the pairs of the last step that
///            returned, and no changes; the next step tells what has changed since that one.
/// Callbacks: `accept` may use other worlds and what is const of its own, but for findBetween(), which would ask it again;
///            all else of it throws InvalidArgument, and the world must not be moved or destroyed. A task of the executor
///            the same.
/// Moving:    a world that has been moved from is as a new one with default options.
///
/// The lists of a step are valid until the next step. Queries return memory of their own.
class World {
 public:
  explicit World(WorldOptions options = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  [[nodiscard]] const WorldOptions& options() const noexcept;

  /// Makes room for so many boxes, so that adding them allocates little.
  void reserve(std::size_t boxes);

  /// Adds a box and returns its id.
  BoxId add(const Box& box, const BoxProperties& properties = {});

  /// Adds boxes and writes their ids.
  ///
  /// There are as many properties as boxes, or one for all of them, or none for the defaults.
  void add(const BoxView& boxes, std::span<const BoxProperties> properties, std::span<BoxId> ids);
  [[nodiscard]] std::vector<BoxId> add(const BoxView& boxes, const BoxProperties& properties = {});

  /// Gives a box new bounds. A box that is given the bounds that it has is not changed: nothing is tested again; see
  /// invalidate().
  void move(BoxId id, const Box& box);

  /// Gives boxes new bounds: boxes[k] becomes the box ids[k]. Of several for one id the last counts.
  void move(std::span<const BoxId> ids, const BoxView& boxes);

  /// Gives boxes the bounds that hold them on their way through a step: from where they start to where they end.
  ///
  /// A box that is empty at one of the two counts with the other alone.
  void moveSwept(std::span<const BoxId> ids, const BoxView& starts, const BoxView& ends);

  /// The same with the ends given by velocities, in rows of three: start + velocity * duration, in double.
  ///
  /// Bad input: a velocity that is not finite throws InvalidBox, a duration that is not InvalidArgument; an end that is a
  ///            NaN, of an infinite box whose motion overflows, InvalidBox.
  void moveSwept(std::span<const BoxId> ids, const BoxView& starts, std::span<const double> velocities,
                 double duration);

  /// Removes boxes; their pairs are among those that ended at the next step.
  void remove(BoxId id);
  void remove(std::span<const BoxId> ids);

  /// Removes all boxes.
  void clear();

  /// Gives boxes other properties; as many as ids, or one for all. Bad input: a margin that is NaN or -infinity.
  void setProperties(BoxId id, const BoxProperties& properties);
  void setProperties(std::span<const BoxId> ids, std::span<const BoxProperties> properties);

  /// Has the next step ask the filter and `accept` again about the pairs of these boxes, though they didn't move.
  void invalidate(std::span<const BoxId> ids);

  /// Gives back the memory that neither the boxes nor the lists of the last step need. Those lists stay valid; the
  /// next step or query makes the order of the boxes anew. Ids from the highest one in
  /// use on are given again from there: idBound() may be less than before.
  void shrink();

  /// How many boxes there are.
  [[nodiscard]] std::size_t size() const noexcept;

  /// All ids are below.
  [[nodiscard]] BoxId idBound() const noexcept;

  [[nodiscard]] bool contains(BoxId id) const noexcept;

  /// The bounds of a box, in double, which holds float32 exactly; for a swept one those of its whole way.
  [[nodiscard]] Box box(BoxId id) const;
  [[nodiscard]] BoxProperties properties(BoxId id) const;

  /// Finds the pairs of the boxes as they are now, and compares them with those of the last step.
  ///
  /// Cost: O(changed boxes + pairs) while the order is good; a pass over the pairs is all that untouched boxes cost.
  StepResult step();

  /// What the last step gave; empty before the first one.
  [[nodiscard]] StepResult result() const noexcept;

  [[nodiscard]] const WorldStatistics& statistics() const noexcept;

  /// All pairs of a box of this world and a box of `other` that overlap at the mean of the distances of the two worlds,
  /// in the order of the options; first is an id here, second one there.
  ///
  /// Filters apply as within a world, but static boxes meet each other; `accept` of this world is asked.
  [[nodiscard]] std::vector<Pair> findBetween(const World& other) const;

  /// The boxes that overlap a box, widened by their own margins: by ascending id.
  [[nodiscard]] std::vector<BoxId> findOverlapping(const Box& box, const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<BoxId> findOverlapping(const BoxView& boxes, const QueryFilter& filter = {}) const;

  /// The first box that a ray, or a swept box, meets, of several at the same t the one with the least id; without any,
  /// kNoBox.
  ///
  /// Geometry: a box counts with its margin added to its bounds, in double. t is the greatest, over the axes, of the
  ///           quotients in double at which the slab of the box is entered, or 0.
  [[nodiscard]] SweepHit findFirst(const Ray& ray, const QueryFilter& filter = {}) const;
  [[nodiscard]] SweepHit findFirst(const BoxSweep& sweep, const QueryFilter& filter = {}) const;
  void findFirst(std::span<const Ray> rays, std::span<SweepHit> hits, const QueryFilter& filter = {}) const;
  void findFirst(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits, const QueryFilter& filter = {}) const;

  /// All boxes that a ray, or a swept box, meets: by ascending (t, id).
  [[nodiscard]] std::vector<SweepHit> findAll(const Ray& ray, const QueryFilter& filter = {}) const;
  [[nodiscard]] std::vector<SweepHit> findAll(const BoxSweep& sweep, const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<SweepHit> findAll(std::span<const Ray> rays, const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<SweepHit> findAll(std::span<const BoxSweep> sweeps, const QueryFilter& filter = {}) const;

  /// The `count` boxes nearest to a point, or all if there are fewer: by ascending (distance, id).
  ///
  /// Bad input: a point that is not finite throws InvalidArgument.
  [[nodiscard]] std::vector<Neighbor> findNearest(const std::array<double, 3>& point, std::size_t count,
                                                  const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<Neighbor> findNearest(std::span<const std::array<double, 3>> points, std::size_t count,
                                                  const QueryFilter& filter = {}) const;

 private:
  struct State;
  State& state();
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs
