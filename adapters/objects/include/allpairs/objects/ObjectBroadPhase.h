// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Span.h"
#include "allpairs/World.h"
#include "allpairs/objects/NearPairs.h"
#include "allpairs/objects/ObjectRows.h"
#include "allpairs/objects/RoundedBoxes.h"
#include "allpairs/objects/RowSearch.h"

namespace allpairs {

/// Settings of a broad phase of a host's objects; the defaults are right for most programs.
struct ObjectBroadPhaseOptions {
  /// Runs parallel work; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Orders the pairs within a manager by the registration of their first object, and then of their second, where an
  /// object takes the place of one that left. It takes time.
  bool isOrdered = false;
};

/// The broad phase of a host's objects: what our managers for FCL and Coal have in common. It has no idea of their
/// callbacks: a visitor gets objects, and returns true to end the query, which then returns true.
///
/// Object has getAABB(), a box with min_ and max_, overlap() and distance(). Objects stay the caller's; their boxes are
/// read by add() and update().
/// Geometry:  boxes are closed, in their own precision. An empty box has no pairs and no distance.
/// Bad input: a box with a NaN throws InvalidBox: an object that comes with one is not added, one that is there keeps
///            the box that it had, and all others are read. No object, a null pointer, is none.
/// Threads:   const members may be called concurrently while no other member runs; a visitor may call them too.
template <class HostObject>
class ObjectBroadPhase {
 public:
  using Object = HostObject;
  using Bounds = typename ObjectRows<Object>::Bounds;
  using S = typename ObjectRows<Object>::S;

  explicit ObjectBroadPhase(const ObjectBroadPhaseOptions& options) : m_search(options.executor, options.isOrdered) {}

  void reserve(std::size_t more) { m_rows.reserve(m_rows.size() + more); }

  /// Adds an object, or reads again where one that is there is now.
  void add(Object* object) {
    if (object == nullptr) return;
    const std::size_t before = m_rows.size();
    const BoxId number = m_rows.add(object);
    try {
      m_search.reserve(m_rows.bound());  // so that no change of a row is lost for want of memory
      refresh(number);
    } catch (...) {
      if (m_rows.size() != before) remove(object);
      throw;
    }
  }

  /// Removes an object, and returns the number that it had; kNoBox if it was not there.
  BoxId remove(Object* object) {
    const BoxId number = m_rows.remove(object);
    if (number != kNoBox) m_search.note(number);
    return number;
  }

  /// Reads where all objects are now, and throws the first InvalidBox when that is done.
  void update() {
    readAll(m_rows.bound(), [this](std::size_t number) { refresh(static_cast<BoxId>(number)); });
  }

  /// The same for some of them.
  void update(Span<Object* const> objects) {
    readAll(objects.size(), [&](std::size_t i) { update(objects[i]); });
  }

  /// The same for one object.
  void update(Object* object) {
    const BoxId number = m_rows.numberOf(object);
    if (number != kNoBox) refresh(number);
  }

  /// Removes all objects, or none where that throws std::bad_alloc.
  void clear() {
    m_search.clear();
    m_rows.clear();
  }

  [[nodiscard]] const ObjectRows<Object>& rows() const { return m_rows; }

  /// Visits the objects whose boxes overlap that of an object.
  template <class Visit>
  bool eachOverlapping(const Object& object, const Visit& visit) const {
    return eachOverlapping(object.getAABB(), [&](BoxId id) { return visit(m_rows[id]); });
  }

  /// Visits the pairs of objects whose boxes overlap.
  template <class Visit>
  bool eachPair(const Visit& visit) const {
    for (const Pair& pair : pairs()) {
      if (visit(m_rows[pair.first], m_rows[pair.second])) return true;
    }
    return false;
  }

  /// Visits the pairs of an object here and one of others, whose boxes overlap.
  template <class Visit>
  bool eachPairWith(const ObjectBroadPhase& others, const Visit& visit) const {
    const bool areFew = m_search.isFasterByScans(m_rows.rows(), others.m_rows.bound());
    if (areFew || isMuchSmaller(others.m_rows)) return askEachOf(others, visit);
    if (others.isMuchSmaller(m_rows)) {
      return others.askEachOf(*this, [&](Object* other, Object* own) { return visit(own, other); });
    }
    for (const Pair& pair : world().findBetween(others.world())) {
      if (visit(m_rows[pair.first], others.m_rows[pair.second])) return true;
    }
    return false;
  }

  /// The same with a host's objects as they lie, those of a manager of another kind.
  template <class Visit>
  bool eachPairWith(const std::vector<Object*>& others, const Visit& visit) const {
    return std::any_of(others.begin(), others.end(), [&](Object* other) {
      return eachOverlapping(*other, [&](Object* own) { return visit(own, other); });
    });
  }

  /// Asks about the objects within the least distance of one, near ones early; ask(object, least) may
  /// make that smaller. Objects whose boxes overlap its box are asked about however small it is.
  template <class Ask>
  bool eachNear(const Object& object, const Ask& ask, S& least) const {
    return eachNearBox(object.getAABB(), ask, least);
  }

  /// The same for the pairs of objects here: ask(first, second, least).
  template <class Ask>
  bool eachNearPair(const Ask& ask, S& least) const {
    for (const Pair& pair : pairs()) {
      if (ask(m_rows[pair.first], m_rows[pair.second], least)) return true;
    }
    // What is left is apart. A near pair makes the least distance small, and few pairs are within it; else objects ask
    // about the others one by one until few are.
    const Pair first = least > S(0) ? somePairApart(least) : kNoPair;
    if (first != kNoPair && ask(m_rows[first.first], m_rows[first.second], least)) return true;
    BoxId next = 0;
    for (BoxId id = 0; id < m_rows.bound() && least > S(0); ++id) {
      if (id >= next && least != std::numeric_limits<S>::max()) {
        next = 4 * id + 1;
        if (auto near = pairsApart(m_rows, id, least)) return askInTurn(*near, first, ask, least);
      }
      if (m_rows.hasBox(id) && eachNearApart(id, first, ask, least)) return true;
    }
    return false;
  }

  /// The same for the pairs of an object here and one of others: ask(own, other, least).
  template <class Ask>
  bool eachNearPairWith(const ObjectBroadPhase& others, const Ask& ask, S& least) const {
    if (m_rows.size() >= others.m_rows.size()) return askNearEachOf(others, ask, least);
    return others.askNearEachOf(
        *this, [&](Object* other, Object* own, S& now) { return ask(own, other, now); }, least);
  }

  /// The same with a host's objects as they lie, those of a manager of another kind.
  template <class Ask>
  bool eachNearPairWith(const std::vector<Object*>& others, const Ask& ask, S& least) const {
    return std::any_of(others.begin(), others.end(), [&](Object* other) {
      return eachNear(
          *other, [&](Object* own, S& now) { return ask(own, other, now); }, least);
    });
  }

 private:
  struct Candidate {
    S distance = S(0);
    BoxId id = kNoBox;

    friend bool operator<(const Candidate& a, const Candidate& b) {
      return std::pair(a.distance, a.id) < std::pair(b.distance, b.id);
    }
  };

  static constexpr Pair kNoPair{kNoBox, kNoBox};

  /// Up to so many objects, comparing several at once costs more than it saves.
  static constexpr BoxId kOneByOne = 8;

  static Box toBox(const Bounds& bounds) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      box.min[a] = static_cast<double>(bounds.min_[axis]);
      box.max[a] = static_cast<double>(bounds.max_[axis]);
    }
    return box;
  }

  static RoundedBoxes::Row toRounded(const Box& box) {
    return RoundedBoxes::rounded(
        std::array{box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]}.data());
  }

  /// So many times as few boxes are searched for one by one: two hierarchies cost by the larger one (robot_benchmark).
  static constexpr std::size_t kMuchSmaller = 8;

  [[nodiscard]] bool isMuchSmaller(const ObjectRows<Object>& others) const {
    return kMuchSmaller * m_rows.size() <= others.size();
  }

  /// eachPairWith() by a query for each object here.
  template <class Visit>
  bool askEachOf(const ObjectBroadPhase& others, const Visit& visit) const {
    for (BoxId id = 0; id < m_rows.bound(); ++id) {
      const auto visitBoth = [&](BoxId found) { return visit(m_rows[id], others.m_rows[found]); };
      if (m_rows.hasBox(id) && others.eachOverlapping(m_rows.bounds(id), visitBoth)) return true;
    }
    return false;
  }

  /// eachNearPairWith() by a query for each of the others.
  template <class Ask>
  bool askNearEachOf(const ObjectBroadPhase& others, const Ask& ask, S& least) const {
    for (BoxId id = 0; id < others.m_rows.bound(); ++id) {
      const auto askOf = [&](Object* own, S& now) { return ask(own, others.m_rows[id], now); };
      if (others.m_rows.hasBox(id) && eachNearBox(others.m_rows.bounds(id), askOf, least)) return true;
    }
    return false;
  }

  /// Reads where the object with this number is now.
  void refresh(BoxId number) {
    if (m_rows.read(number)) m_search.note(number);
  }

  template <class Read>
  static void readAll(std::size_t count, const Read& read) {
    std::optional<InvalidBox> first;
    for (std::size_t i = 0; i < count; ++i) {
      try {
        read(i);
      } catch (const InvalidBox& invalid) {
        if (!first) first = invalid;
      }
    }
    if (first) throw InvalidBox(*first);
  }

  [[nodiscard]] Span<const Pair> pairs() const { return m_search.pairs(m_rows.rows()); }
  [[nodiscard]] const World& world() const { return m_search.world(m_rows.rows()); }

  /// Whether a box is one; empty ones have no pairs.
  static bool isBox(const Bounds& bounds) {
    const auto& min = bounds.min_;
    const auto& max = bounds.max_;
    if (min[0] <= max[0] && min[1] <= max[1] && min[2] <= max[2]) return true;
    if (hasNan(toBox(bounds))) throw InvalidBox(0, "the box of the query has a NaN");
    return false;
  }

  /// eachNear() of a box.
  template <class Ask>
  bool eachNearBox(const Bounds& bounds, const Ask& ask, S& least) const {
    const auto askAbout = [&](BoxId id) { return ask(m_rows[id], least); };
    const auto isWanted = [](BoxId) { return true; };
    return isBox(bounds) &&
           askNear(Question<decltype(isWanted), decltype(askAbout)>{bounds, isWanted, askAbout, 0}, least);
  }

  /// Calls visit(id) for the objects whose boxes overlap a box until it returns true, and says whether it did.
  template <class Visit>
  bool eachOverlapping(const Bounds& bounds, const Visit& visit) const {
    if (!isBox(bounds) || !m_rows.mayOverlap(bounds)) return false;
    return m_rows.bound() <= kOneByOne ? scanFew(bounds, visit) : scanMany(bounds, visit);
  }

  template <class Visit>
  bool scanFew(const Bounds& bounds, const Visit& visit) const {
    for (BoxId id = 0; id < m_rows.bound(); ++id) {
      if (m_rows.overlaps(id, bounds) && visit(id)) return true;
    }
    return false;
  }

  template <class Visit>
  bool scanMany(const Bounds& bounds, const Visit& visit) const {
    const Box box = toBox(bounds);
    const auto visitIf = [&](BoxId id) { return m_rows.overlaps(id, bounds) && visit(id); };
    const World* const world = m_search.worldForQuery(m_rows.rows());
    if (world == nullptr) return eachRounded(box, 0, visitIf);
    const std::vector<BoxId> found = world->findOverlapping(box);
    return std::any_of(found.begin(), found.end(), visitIf);
  }

  /// Two objects that are apart and, as they are the nearest of some objects, often near to each other; kNoPair if none
  /// of them is within the least distance.
  [[nodiscard]] Pair somePairApart(S least) const {
    constexpr BoxId kSome = 4;
    const RoundedBoxes& rounded = m_search.rounded(m_rows.rows());
    NearPair<S> best{limitOf(least), kNoPair};
    for (BoxId id = 0; id < m_rows.bound(); id += m_rows.bound() / kSome + 1) {
      const BoxId other = m_rows.hasBox(id) ? rounded.nearest(toRounded(toBox(m_rows.bounds(id))), id) : kNoBox;
      if (other == kNoBox || !m_rows.hasBox(other) || m_rows.overlaps(other, m_rows.bounds(id))) continue;
      const Pair pair{std::min(id, other), std::max(id, other)};
      best = std::min(best, {m_rows.bounds(id).distance(m_rows.bounds(other)), pair});
    }
    return best.pair;
  }

  /// Asks about pairs but for one, of which that was done, the nearest first.
  template <class Ask>
  bool askInTurn(std::vector<NearPair<S>>& near, Pair except, const Ask& ask, S& least) const {
    const auto askOne = [&](const NearPair<S>& one) {
      return one.pair != except && ask(m_rows[one.pair.first], m_rows[one.pair.second], least);
    };
    return nearestFirst(near.begin(), near.end(), askOne, least);
  }

  /// Asks about the objects behind one that are apart from it and near, but for a pair of which that was done.
  template <class Ask>
  bool eachNearApart(BoxId id, Pair except, const Ask& ask, S& least) const {
    const Bounds bounds = m_rows.bounds(id);
    const auto askBoth = [&](BoxId other) { return ask(m_rows[id], m_rows[other], least); };
    const auto isWanted = [&](BoxId other) {
      return other > id && Pair{id, other} != except && !bounds.overlap(m_rows.bounds(other));
    };
    return askNear(Question<decltype(isWanted), decltype(askBoth)>{bounds, isWanted, askBoth, id + 1}, least);
  }

  /// Which objects to ask about that are near a box, and how.
  template <class IsWanted, class Ask>
  struct Question {
    const Bounds& bounds;
    const IsWanted& isWanted;
    const Ask& ask;
    BoxId begin = 0;  ///< No object before it is wanted.
  };

  /// Boxes that overlap are asked about however small the least distance is.
  static S limitOf(S least) { return std::max(least, S(0)); }

  template <class AnyQuestion>
  bool askNear(const AnyQuestion& question, S& least) const {
    return m_rows.bound() <= kOneByOne ? askFew(question, least) : askMany(question, least);
  }

  template <class AnyQuestion>
  bool askFew(const AnyQuestion& question, S& least) const {
    std::array<Candidate, kOneByOne> left;
    auto end = left.begin();
    for (BoxId id = question.begin; id < m_rows.bound(); ++id) {
      if (isCandidate(question, id, least, *end)) ++end;
    }
    return askInTurn(left.begin(), end, question, least);
  }

  template <class AnyQuestion>
  bool askMany(const AnyQuestion& question, S& least) const {
    const World* const world = m_search.worldForQuery(m_rows.rows());
    return world != nullptr ? askInWorld(*world, question, least) : askAll(question, least);
  }

  /// Asks about near objects, and as soon as one makes the least distance smaller, only about those that are nearer.
  template <class AnyQuestion>
  bool askInWorld(const World& world, const AnyQuestion& question, S& least) const {
    const double most = magnitude(question.bounds);
    double within = reachOf(least, most);
    bool isEnded = false;
    if (std::isnan(within)) return false;
    world.visitNear(toBox(question.bounds), within, [&](BoxId id) {
      Candidate candidate;
      if (id < question.begin || !isCandidate(question, id, least, candidate)) return within;
      isEnded = question.ask(id);
      return within = isEnded ? -1.0 : reachOf(least, most);
    });
    return isEnded;
  }

  /// Asks about an object that is near, which makes the least distance small, and then about all that are nearer.
  template <class AnyQuestion>
  bool askAll(const AnyQuestion& question, S& least) const {
    const BoxId first = least == std::numeric_limits<S>::max() ? nearest(question) : kNoBox;
    if (first != kNoBox && question.ask(first)) return true;
    std::vector<Candidate> left;
    Candidate candidate;
    const Box reach = widened(question.bounds, limitOf(least));
    eachRounded(reach, question.begin, [&](BoxId id) {
      if (id != first && isCandidate(question, id, least, candidate)) left.push_back(candidate);
      return false;
    });
    return askInTurn(left.begin(), left.end(), question, least);
  }

  /// Calls visit(id) for the objects whose boxes overlap a box, and for some others, until it returns true, and says
  /// whether it did. Those before a first one may be left out.
  template <class Visit>
  bool eachRounded(const Box& box, BoxId begin, const Visit& visit) const {
    const RoundedBoxes& rounded = m_search.rounded(m_rows.rows());
    const RoundedBoxes::Row row = toRounded(box);
    for (std::size_t block = begin / RoundedBoxes::kBlock; block < rounded.blocks(); ++block) {
      for (std::uint64_t bits = rounded.mayOverlap(block, row); bits != 0; bits &= bits - 1) {
        if (visit(idOf(block, bits))) return true;
      }
    }
    return false;
  }

  /// Whether a question is about an object, which then is the candidate.
  template <class AnyQuestion>
  bool isCandidate(const AnyQuestion& question, BoxId id, S least, Candidate& candidate) const {
    if (!m_rows.hasBox(id) || !question.isWanted(id)) return false;
    candidate = {question.bounds.distance(m_rows.bounds(id)), id};
    return candidate.distance <= limitOf(least);
  }

  /// Asks about objects, the nearest first.
  template <class Iterator, class AnyQuestion>
  static bool askInTurn(Iterator begin, Iterator end, const AnyQuestion& question, const S& least) {
    return nearestFirst(
        begin, end, [&](const Candidate& one) { return question.ask(one.id); }, least);
  }

  /// Asks about the nearest first, as long as they are near enough.
  template <class Iterator, class Ask>
  static bool nearestFirst(Iterator begin, Iterator end, const Ask& ask, const S& least) {
    const auto isFarther = [](const auto& a, const auto& b) { return b < a; };
    for (std::make_heap(begin, end, isFarther); begin != end && begin->distance <= limitOf(least); --end) {
      if (ask(*begin)) return true;
      std::pop_heap(begin, end, isFarther);
    }
    return false;
  }

  /// The number of the box of the lowest bit of a block that is set, of which there is one; std::countr_zero is of
  /// C++20.
  static BoxId idOf(std::size_t block, std::uint64_t bits) {
    return static_cast<BoxId>(block * RoundedBoxes::kBlock) + static_cast<BoxId>(__builtin_ctzll(bits));
  }

  /// A wanted object near a box; kNoBox if there is none, or none was found.
  template <class AnyQuestion>
  [[nodiscard]] BoxId nearest(const AnyQuestion& question) const {
    if (question.begin != 0) return kNoBox;  // the question is about an object here, which is the nearest
    const BoxId id = m_search.rounded(m_rows.rows()).nearest(toRounded(toBox(question.bounds)));
    return id != kNoBox && m_rows.hasBox(id) && question.isWanted(id) ? id : kNoBox;
  }

  static double magnitude(double bound) { return std::isfinite(bound) ? std::abs(bound) : 0.0; }

  /// The greatest of the finite bounds of a box.
  static double magnitude(const Bounds& bounds) {
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const S bound : {bounds.min_[axis], bounds.max_[axis]}) {
        most = std::max(most, magnitude(static_cast<double>(bound)));
      }
    }
    return most;
  }

  /// At most the distance, in double, of what the host finds within the least distance of a box, however it rounds.
  static double reachOf(S least, double most) {
    if (least == std::numeric_limits<S>::max()) return std::numeric_limits<double>::infinity();
    const auto within = static_cast<double>(limitOf(least));
    return within + 16.0 * static_cast<double>(std::numeric_limits<S>::epsilon()) * std::max(most, within);
  }

  /// Holds all boxes that the host finds within a distance, however it rounds: by the finite bounds, which it takes
  /// gaps from.
  [[nodiscard]] static Box widened(const Bounds& bounds, S distance) {
    Box box = toBox(bounds);
    const auto by = static_cast<double>(distance);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double most = std::max({magnitude(box.min[axis]), magnitude(box.max[axis]), magnitude(by)});
      const double slack = 8.0 * static_cast<double>(std::numeric_limits<S>::epsilon()) * most;
      if (std::isfinite(box.min[axis])) box.min[axis] -= by + slack;
      if (std::isfinite(box.max[axis])) box.max[axis] += by + slack;
    }
    return box;
  }

  ObjectRows<Object> m_rows;
  mutable RowSearch<S> m_search;  // queries are const; these find what they need when it is asked for
};

}  // namespace allpairs
