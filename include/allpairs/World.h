// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/Pair.h"
#include "allpairs/Span.h"
#include "allpairs/WorldTypes.h"

namespace allpairs {

/// Moving boxes: their overlapping pairs step by step, and queries against them.
///
/// Boxes are added, moved and removed by id, one or many at a time. step() gives the current pairs of all boxes and the
/// changes since the previous step. The hierarchy of the boxes is kept between steps, so that a step costs what has
/// changed: docs/decisions/0007 explains how, and when the hierarchy is rebuilt.
///
/// A box may have the number of a world, one of many in the same object, such as the copies of a scene that robots
/// learn in: boxes of different worlds are never pairs and are not tested against each other, wherever they are. Boxes
/// of kEveryWorld, such as the ground, are in each. Without numbers all boxes are of world 0.
///
/// Geometry:  as in OverlapSearch: boxes are closed; empty boxes overlap nothing; infinite bounds are allowed. Bounds
///            given in float64 are exact. A margin is part of a pair's distance, and in rays, sweeps and
///            findNearest() enlarges the box itself.
/// Ids:       ids of removed boxes are reused, but only after the step that reports that their pairs have ended, so
///            that within the lists of a step an id means one box. Ids of boxes added to a new world are consecutive.
/// Bad input: a box with a NaN, or an id that is not in the world, throws InvalidBox, whose index() is the position in
///            the batch and whose message names the id; the batch then has no effect. Spans of different lengths, and a
///            BoxView with margins, throw InvalidArgument: here a margin is a property.
/// Cost:      up to 220 bytes per box after reserve(), 300 without it, and 70 per pair, and some 200 KB for itself. In
///            a steady state, on the calling thread, nothing is allocated. With world numbers, a step searches the
///            worlds in which a box has changed, small ones as a whole, and all of them if a box of every world has;
///            when boxes were added, removed or given another world, it also copies the ids of all boxes. The first
///            query makes hierarchies of small worlds too, which have up to 450 bytes per box where a world has five.
/// Threads:   const members, queries included, may be called concurrently while no other member runs; all others one at
///            a time. Parallel inside if the options have an executor. Results never depend on threads or the
///            instruction set.
/// Memory:    a call that throws, whether std::bad_alloc or an exception of `accept`, leaves all boxes unchanged: a
///            batch is applied completely or not at all. After a step() that threw, result() has the pairs of the last
///            step that returned, and no changes; the next step reports the changes since that one.
/// Callbacks: `accept` may use other worlds, and const members of the world that calls it. Of these it must not call
///            findBetween(), which would call `accept` again until the stack is full. All others, those that change
///            the world, throw InvalidArgument, and it must not move or destroy that world. A task of the executor,
///            and what a stop flag asks, may use other worlds too, and of the world that runs them what reads boxes
///            and the last result: box(), contains(), properties(), size(), idBound(), result(). They must not change
///            it. While its hierarchies or lists are about to change, queries and result(world) throw InvalidArgument
///            there. An executor must not ask the world outside of the tasks. Worlds whose stop flags or tasks use each
///            other in a circle wait for ever, or are refused.
/// Moving:    a moved-from world is like a new one with default options.
///
/// The lists of a step are valid until the next step. Queries return their own memory.
class World {
 public:
  explicit World(WorldOptions options = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  [[nodiscard]] const WorldOptions& options() const noexcept;

  /// Reserves memory for that many boxes, so that adding them allocates little.
  void reserve(std::size_t boxes);

  /// Adds a box and returns its id.
  BoxId add(const Box& box, const BoxProperties& properties = {});

  /// Adds boxes and writes their ids.
  ///
  /// Pass one property per box, one for all boxes, or none for the defaults.
  void add(const BoxView& boxes, Span<const BoxProperties> properties, Span<BoxId> ids);
  [[nodiscard]] std::vector<BoxId> add(const BoxView& boxes, const BoxProperties& properties = {});

  /// Sets the bounds of a box. Setting equal bounds does not change the box, and nothing is tested again; see
  /// invalidate().
  void move(BoxId id, const Box& box);

  /// Sets the bounds of box ids[k] to boxes[k]. If an id occurs several times, the last one counts.
  void move(Span<const BoxId> ids, const BoxView& boxes);

  /// Sets the bounds of boxes to their swept volume in a step: the union of start and end.
  ///
  /// If one of the two is empty, only the other counts.
  void moveSwept(Span<const BoxId> ids, const BoxView& starts, const BoxView& ends);

  /// The same, with the end computed from velocities, in rows of three: start + velocity * duration, in double. An
  /// empty start stays as it is.
  ///
  /// Bad input: a velocity that is not finite throws InvalidBox, and so does a motion of an infinite box that overflows
  ///            and gives a NaN; a duration that is not finite throws InvalidArgument.
  void moveSwept(Span<const BoxId> ids, const BoxView& starts, Span<const double> velocities, double duration);

  /// Removes boxes; the next step lists their pairs among those that ended.
  void remove(BoxId id);
  void remove(Span<const BoxId> ids);

  /// Removes all boxes.
  void clear();

  /// Sets the properties of boxes: one per id, or one for all. Bad input: a margin that is NaN or -infinity.
  ///
  /// A box may also go to another world: its pairs end, and others begin.
  void setProperties(BoxId id, const BoxProperties& properties);
  void setProperties(Span<const BoxId> ids, Span<const BoxProperties> properties);

  /// Makes the next step apply the filter and `accept` again to the pairs of these boxes, although they did not move.
  void invalidate(Span<const BoxId> ids);

  /// Releases the memory that neither the boxes nor the lists of the last step need. Those lists stay valid; the next
  /// step or query rebuilds the hierarchy. Ids above the highest one in use become free: idBound() may decrease.
  void shrink();

  /// The number of boxes.
  [[nodiscard]] std::size_t size() const noexcept;

  /// A bound on the ids: all are smaller.
  [[nodiscard]] BoxId idBound() const noexcept;

  [[nodiscard]] bool contains(BoxId id) const noexcept;

  /// The bounds of a box, in double, which represents float32 exactly; for a swept box, those of its swept volume.
  [[nodiscard]] Box box(BoxId id) const;
  [[nodiscard]] BoxProperties properties(BoxId id) const;

  /// Finds the current pairs, and compares them with those of the last step.
  ///
  /// Cost: O(changed boxes + pairs) while the hierarchy is good; unchanged boxes cost only a pass over their pairs.
  StepResult step();

  /// The result of the last step; empty before the first one.
  [[nodiscard]] StepResult result() const noexcept;

  /// The lists of the last step for one world: the pairs of its boxes with each other and with those of every world, in
  /// the same order. With kEveryWorld, the pairs of two boxes of every world. Empty for a number that no box
  /// has or had in the step before.
  ///
  /// A box that is given another world ends its pairs there and begins them here.
  /// Cost:    O(log pairs), after a pass over all pairs in the first call after a step: cheap if ids ascend with the
  ///          numbers of their worlds and boxes of every world were added last, else a sort, of no more than 2^32 pairs
  ///          (LimitExceeded), with up to 50 bytes more per pair, and 75 once a box was given another world.
  /// Threads: like a query, which a stop flag ends too.
  [[nodiscard]] StepResult result(std::uint32_t world) const;

  [[nodiscard]] const WorldStatistics& statistics() const noexcept;

  /// All pairs of a box of this world and a box of `other` that overlap at the mean of the distances of the two worlds,
  /// in the order of the options; first is an id of this world, second one of `other`.
  ///
  /// Filters apply as within a world, except that two static boxes are tested too; `accept` of this world is called.
  [[nodiscard]] std::vector<Pair> findBetween(const World& other) const;

  /// The boxes that would be a pair with a box, with their margins as its distance: by ascending id. The distance of
  /// the options, which is of pairs, is not added: enlarge the box by it.
  ///
  /// Geometry: the margin is added to a maximum, the box's or the other's, in double, as in a pair. Rays, sweeps and
  ///           findNearest() take it from the minimum, and may differ where such a sum is rounded; a box that a
  ///           negative margin turns over is hit by no ray; it overlaps what holds all between its bounds, and a sweep
  ///           of that hits it.
  /// Cost: of this query and those below, with world numbers, that of one world if the filter names it; else all worlds
  ///       are searched one after the other.
  [[nodiscard]] std::vector<BoxId> findOverlapping(const Box& box, const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<BoxId> findOverlapping(const BoxView& boxes, const QueryFilter& filter = {}) const;

  /// The first box that a ray, or a swept box, hits; of several at the same t, the one with the smallest id; kNoBox
  /// without a hit.
  ///
  /// Geometry: a box is enlarged by its margin, in double. t is the maximum over the axes of the parameters, quotients
  ///           in double, at which the ray enters the box's slabs, or 0.
  [[nodiscard]] SweepHit findFirst(const Ray& ray, const QueryFilter& filter = {}) const;
  [[nodiscard]] SweepHit findFirst(const BoxSweep& sweep, const QueryFilter& filter = {}) const;
  void findFirst(Span<const Ray> rays, Span<SweepHit> hits, const QueryFilter& filter = {}) const;
  void findFirst(Span<const BoxSweep> sweeps, Span<SweepHit> hits, const QueryFilter& filter = {}) const;

  /// All boxes that a ray, or a swept box, hits: by ascending (t, id).
  [[nodiscard]] std::vector<SweepHit> findAll(const Ray& ray, const QueryFilter& filter = {}) const;
  [[nodiscard]] std::vector<SweepHit> findAll(const BoxSweep& sweep, const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<SweepHit> findAll(Span<const Ray> rays, const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<SweepHit> findAll(Span<const BoxSweep> sweeps, const QueryFilter& filter = {}) const;

  /// The `count` boxes nearest to a point or a box, or all if there are fewer: by ascending (distance, id).
  /// An empty box is near nothing.
  ///
  /// Bad input: a point that is not finite throws InvalidArgument, a box with a NaN InvalidBox.
  [[nodiscard]] std::vector<Neighbor> findNearest(const std::array<double, 3>& point, std::size_t count,
                                                  const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<Neighbor> findNearest(Span<const std::array<double, 3>> points, std::size_t count,
                                                  const QueryFilter& filter = {}) const;
  template <class T>  // so that {x, y, z} is a point
  [[nodiscard]] std::vector<Neighbor> findNearest(const BasicBox<T>& box, std::size_t count,
                                                  const QueryFilter& filter = {}) const;
  [[nodiscard]] ResultLists<Neighbor> findNearest(const BoxView& boxes, std::size_t count,
                                                  const QueryFilter& filter = {}) const;

  /// Visits the boxes within a distance of a box, near ones early, to find what is nearest by another measure: the
  /// distance of the shapes in the boxes, which is at least that of the boxes. visit(id) returns the distance within
  /// which others are wanted from then on, a negative one to end; a greater one than before changes nothing.
  ///
  /// A box is visited at most once. Some are a little farther, since distances are compared in float32; none of those
  /// that are left out is within the last distance. The visitor may use const members of the world, and must not
  /// change it.
  /// An empty box is near nothing. A visitor that returns a NaN ends the query.
  /// Bad input: a box with a NaN throws InvalidBox, a distance that is a NaN InvalidArgument.
  void visitNear(const Box& box, double distance, FunctionRef<double(BoxId)> visit,
                 const QueryFilter& filter = {}) const;

 private:
  struct State;
  State& state();
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs
