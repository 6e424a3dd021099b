// SPDX-License-Identifier: MIT
// A world's life, operation by operation, beside the oracle of double loops that the tests use too.
#include "allpairs/World.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "../BackwardExecutor.h"
#include "../Choices.h"
#include "WorldQueries.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "engine/WorldOracle.h"

namespace allpairs::fuzz {
namespace {

constexpr std::size_t kMostOperations = 120;  // With 250 boxes, some tenths of a second under sanitizers.

bool hasNanBound(const Box& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isnan(box.min[k]) || std::isnan(box.max[k])) return true;
  }
  return false;
}

/// The smallest box that holds both; one that is empty adds nothing.
Box joined(const Box& a, const Box& b) {
  if (test::WorldOracle::empty(a)) return b;
  if (test::WorldOracle::empty(b)) return a;
  Box result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.min[k] = std::min(a.min[k], b.min[k]);
    result.max[k] = std::max(a.max[k], b.max[k]);
  }
  return result;
}

class Life {
 public:
  explicit Life(Choices& choices) : m_choices(choices), m_world(readOptions()) {
    m_oracle.distance = m_world.options().distance;
    m_oracle.order = m_world.options().order;
  }

  void lead() {
    for (std::size_t i = 0; i < kMostOperations && !m_choices.done(); ++i) operate();
    compareStep();
    compareStep();
  }

 private:
  WorldOptions readOptions() {
    WorldOptions options;
    options.distance = m_choices.distance();
    options.instructionSet = instructionSets()[m_choices.below(instructionSets().size())];
    const std::uint8_t parts = m_choices.byte();
    if ((parts & 1U) != 0) options.executor = &m_executor;
    if ((parts & 4U) != 0) options.order = Order::BySecond;
    if ((parts & 2U) != 0) options.accept = [this](BoxId a, BoxId b) { return accepts(a, b); };
    return options;
  }

  /// Depends on what each box was given when it was added or touched, so that it changes only when the world is told.
  bool accepts(BoxId a, BoxId b) {
    if (m_isBetween) return (a + b) % 3 != 0;  // b is of another world
    require(a < b, "accept is asked about first < second");
    return (m_tokens.at(a) * 31 + m_tokens.at(b) * 17) % 3 != 0;
  }

  void operate() {
    switch (m_choices.below(16)) {
      case 0:
      case 1:
        return add();
      case 2:
      case 3:
        return move();
      case 4:
        return moveSwept();
      case 5:
        return moveByVelocity();
      case 6:
        return remove();
      case 7:
        return setProperties();
      case 8:
        return invalidate();
      case 9:
        return unusual();
      case 10:
        return refuse();
      case 11:
        return queries().compareOverlapping();
      case 12:
        return queries().compareSweeps();
      case 13:
        return queries().compareNearest();
      default:
        return compareStep();
    }
  }

  BoxProperties properties() {
    BoxProperties p;
    const std::uint8_t parts = m_choices.byte();
    p.isStatic = (parts & 1U) != 0;
    if ((parts & 2U) != 0) p.margin = m_choices.distance();
    if ((parts & 4U) != 0) p.category = 1U << m_choices.below(3);
    if ((parts & 8U) != 0) p.mask = m_choices.byte() % 8U;
    if ((parts & 16U) != 0) p.group = m_choices.byte() % 3U;
    if ((parts & 32U) != 0) p.world = kWorlds[m_choices.below(kWorlds.size())];
    return p;
  }

  void add() {
    std::vector<Box> boxes = m_choices.boxes(kMostInWorld / 2);
    if (m_oracle.boxes.size() + boxes.size() > kMostInWorld) return;
    std::vector<BoxProperties> all(m_choices.flag() ? boxes.size() : 1);
    for (BoxProperties& p : all) p = properties();
    std::vector<BoxId> ids(boxes.size());
    withView(m_choices, boxes, [&](const BoxView& view) { m_world.add(view, all, ids); });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      require(!m_oracle.boxes.contains(ids[i]), "the id of a new box is not in use");
      require(!wasInStep(ids[i]), "the id of a new box is not in the last step's lists");
      m_oracle.boxes[ids[i]] = {boxes[i], all.size() == 1 ? all.front() : all[i]};
      m_tokens[ids[i]] = ++m_lastToken;
    }
  }

  [[nodiscard]] bool wasInStep(BoxId id) const {
    return std::any_of(m_oracle.pairs.begin(), m_oracle.pairs.end(),
                       [&](Pair p) { return p.first == id || p.second == id; });
  }

  /// Some of the ids, each at most once, in an order of the input's choice.
  std::vector<BoxId> someIds() {
    std::vector<BoxId> ids;
    const std::size_t every = 1 + m_choices.below(16);
    std::size_t next = m_choices.below(every);
    for (const auto& [id, entry] : m_oracle.boxes) {
      if (next-- == 0) ids.push_back(id), next = every - 1;
    }
    if (m_choices.flag()) std::reverse(ids.begin(), ids.end());
    return ids;
  }

  /// New bounds for boxes: near the old ones, or anywhere.
  std::vector<Box> newBounds(const std::vector<BoxId>& ids) {
    std::vector<Box> boxes;
    const bool near = m_choices.flag();
    const double by = near ? 0.25 * m_choices.finite() : 0.0;
    for (const BoxId id : ids) {
      Box box = near ? m_oracle.boxes[id].box : m_choices.box();
      for (std::size_t k = 0; near && k < 3; ++k) box.min[k] += by, box.max[k] += by;
      boxes.push_back(box);
    }
    return boxes;
  }

  void move() {
    std::vector<BoxId> ids = someIds();
    std::vector<Box> boxes = newBounds(ids);
    if (!ids.empty() && m_choices.flag()) ids.push_back(ids.front()), boxes.push_back(m_choices.box());
    withView(m_choices, boxes, [&](const BoxView& view) { m_world.move(ids, view); });
    for (std::size_t i = 0; i < ids.size(); ++i) m_oracle.boxes[ids[i]].box = boxes[i];
  }

  void moveSwept() {
    const std::vector<BoxId> ids = someIds();
    std::vector<Box> starts = newBounds(ids);
    std::vector<Box> ends = newBounds(ids);
    withView(m_choices, starts, [&](const BoxView& from) {
      withView(m_choices, ends, [&](const BoxView& to) { m_world.moveSwept(ids, from, to); });
    });
    for (std::size_t i = 0; i < ids.size(); ++i) m_oracle.boxes[ids[i]].box = joined(starts[i], ends[i]);
  }

  void moveByVelocity() {
    const std::vector<BoxId> ids = someIds();
    std::vector<Box> starts = newBounds(ids);
    std::vector<double> velocities(ids.size() * 3);
    for (double& v : velocities) v = m_choices.finite();
    const double duration = m_choices.finite();
    std::vector<Box> swept;
    bool isRefused = false;
    withView(m_choices, starts, [&](const BoxView& from) {
      for (std::size_t i = 0; i < ids.size(); ++i) {
        Box end = starts[i];
        for (std::size_t k = 0; k < 3; ++k) {
          end.min[k] += velocities[3 * i + k] * duration;
          end.max[k] += velocities[3 * i + k] * duration;
        }
        // The end of an empty box may not be empty, by rounding, or a NaN; the box stays.
        const bool isMoved = !test::WorldOracle::empty(starts[i]);
        isRefused = isRefused || (isMoved && hasNanBound(end));
        swept.push_back(isMoved ? joined(starts[i], end) : starts[i]);
      }
      try {
        m_world.moveSwept(ids, from, velocities, duration);
        require(!isRefused, "a motion to a NaN is refused");
      } catch (const InvalidBox&) {
        require(isRefused, "a motion between numbers is not refused");
      }
    });
    for (std::size_t i = 0; i < ids.size() && !isRefused; ++i) m_oracle.boxes[ids[i]].box = swept[i];
  }

  void remove() {
    const std::vector<BoxId> ids = someIds();
    m_world.remove(ids);
    for (const BoxId id : ids) m_oracle.boxes.erase(id);
  }

  void setProperties() {
    const std::vector<BoxId> ids = someIds();
    if (ids.empty()) return;
    std::vector<BoxProperties> all(m_choices.flag() ? ids.size() : 1);
    for (BoxProperties& p : all) p = properties();
    m_world.setProperties(ids, all);
    for (std::size_t i = 0; i < ids.size(); ++i) m_oracle.boxes[ids[i]].properties = all.size() == 1 ? all[0] : all[i];
  }

  void invalidate() {
    const std::vector<BoxId> ids = someIds();
    for (const BoxId id : ids) m_tokens[id] = ++m_lastToken;
    m_world.invalidate(ids);
  }

  void unusual() {
    switch (m_choices.below(5)) {
      case 3:
        return m_world.shrink();
      case 0:
        m_world.clear();
        m_oracle.boxes.clear();
        return;
      case 1:
        return m_world.reserve(m_choices.below(2000));
      case 2: {
        World other = std::move(m_world);
        m_world = std::move(other);
        return;
      }
      default:
        return compareBetween();
    }
  }

  /// Asks for what must be refused; that nothing has been done shows later.
  void refuse() {
    std::vector<BoxId> ids = someIds();
    std::vector<Box> boxes = newBounds(ids);
    ids.push_back(m_world.idBound() + static_cast<BoxId>(m_choices.below(3)));
    boxes.push_back(m_choices.box());
    std::vector<double> velocities(ids.size() * 3, 1.0);
    const BoxProperties other{.category = 1, .margin = 2.0};
    const std::size_t kind = m_choices.below(6);
    bool isRefused = false;
    try {
      if (kind == 0) m_world.move(ids, boxes);
      if (kind == 1) m_world.moveSwept(ids, boxes, boxes);
      if (kind == 2) m_world.moveSwept(ids, boxes, velocities, 1.0);
      if (kind == 3) m_world.remove(ids);
      if (kind == 4) m_world.setProperties(ids, std::span(&other, 1));
      if (kind == 5) m_world.invalidate(ids);
    } catch (const InvalidBox& error) {
      isRefused = true;
      require(error.index() == ids.size() - 1, "the error names the place of the id that isn't there");
    }
    require(isRefused, "an id that isn't there is refused");
  }

  void compareStep() {
    std::vector<Pair> now = m_oracle.pairsNow();  // The oracle has no accept.
    if (m_world.options().accept) std::erase_if(now, [this](Pair p) { return !accepts(p.first, p.second); });
    m_oracle.become(now);
    requireLists(m_world.step(), m_oracle, "a step gives the pairs of the double loop, and what changed");
    compareEachWorld(now);
    compareBoxes();
  }

  static void requireLists(const StepResult& result, const test::WorldOracle& oracle, std::string_view property) {
    require(std::ranges::equal(result.pairs, oracle.pairs) && std::ranges::equal(result.began, oracle.began) &&
                std::ranges::equal(result.persisted, oracle.persisted) &&
                std::ranges::equal(result.ended, oracle.ended),
            property);
  }

  void compareEachWorld(const std::vector<Pair>& now) {
    for (const std::uint32_t number : kWorlds) {
      test::WorldOracle& oracle = m_each[number];
      oracle.order = m_oracle.order;
      std::vector<Pair> own;
      for (const Pair pair : now) {
        if (m_oracle.worldOf(pair) == number) own.push_back(pair);
      }
      oracle.become(own);
      requireLists(m_world.result(number), oracle, "a world's lists have what is in it, and what changed there");
    }
  }

  void compareBoxes() const {
    require(m_world.size() == m_oracle.boxes.size(), "size() is how many boxes there are");
    for (BoxId id = 0; id < m_world.idBound(); ++id) {
      require(m_world.contains(id) == m_oracle.boxes.contains(id), "contains() knows what is in the world");
    }
    for (const auto& [id, entry] : m_oracle.boxes) {
      const Box box = m_world.box(id);
      const bool areEmpty = test::WorldOracle::empty(box) && test::WorldOracle::empty(entry.box);
      require(areEmpty || box == entry.box, "box() gives the bounds that were given");
      require(m_world.properties(id) == entry.properties, "properties() gives what was given");
    }
  }

  [[nodiscard]] WorldQueries queries() { return {m_choices, m_world, m_oracle}; }

  /// A second world of a few boxes, and the pairs between the two.
  void compareBetween() {
    m_isBetween = true;
    WorldOptions options;
    options.distance = m_choices.distance();
    options.instructionSet = m_world.options().instructionSet;
    World other(options);
    std::vector<Box> boxes = m_choices.boxes(40);
    const std::vector<BoxProperties> all(boxes.size(), properties());
    std::vector<BoxId> ids(boxes.size());
    other.add(boxes, all, ids);
    const double distance = std::midpoint(m_world.options().distance, other.options().distance);  // Never overflows.
    std::vector<Pair> expected;
    for (const auto& [a, entry] : m_oracle.boxes) {
      BoxProperties p = entry.properties;
      p.isStatic = false;  // static boxes of two worlds meet
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double d = distance + p.margin + all[i].margin;
        if (test::WorldOracle::apart(entry.box, boxes[i], d) || !test::WorldOracle::mayPair(p, all[i])) continue;
        if (!m_world.options().accept || accepts(a, ids[i])) expected.push_back({a, ids[i]});
      }
    }
    std::sort(expected.begin(), expected.end(), [this](Pair a, Pair b) { return m_oracle.isBefore(a, b); });
    const auto pairs = m_world.findBetween(other);
    m_isBetween = false;
    require(std::ranges::equal(pairs, expected), "findBetween gives the pairs of the double loop");
  }

  Choices& m_choices;
  BackwardExecutor m_executor;
  std::map<BoxId, std::uint32_t> m_tokens;
  std::uint32_t m_lastToken = 0;
  bool m_isBetween = false;
  World m_world;
  test::WorldOracle m_oracle;
  std::map<std::uint32_t, test::WorldOracle> m_each;  ///< By world number.
};

void runWorld(Bytes bytes) {
  Choices choices(bytes);
  Life(choices).lead();
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(world, allpairs::fuzz::runWorld)
