// SPDX-License-Identifier: MIT
// The pairs of two broad phases, in order, while one of them moves, and whenever a visitor ends a query.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "PlainObject.h"
#include "allpairs/objects/ObjectBroadPhase.h"

namespace allpairs::test {
namespace {

using Pairs = std::vector<std::pair<const Object*, const Object*>>;

/// Objects, and a broad phase that has them all.
class Group {
 public:
  Group(std::size_t count, unsigned seed) : m_random(seed), m_objects(count) {
    move();
    for (Object& object : m_objects) broadPhase.add(&object);
  }

  /// Moves all within a cube, and each fifth time in a corner of it, or partly out of it. One is empty.
  void move() {
    const double size = m_moves % 5 == 1 ? 2.0 : m_moves % 5 == 2 ? 20.0 : 10.0;
    ++m_moves;
    std::uniform_real_distribution<double> place(0.0, size);
    for (Object& object : m_objects) {
      const double x = place(m_random);
      const double y = place(m_random);
      const double z = place(m_random);
      object.bounds = {{x, y, z}, {x + 1.5, y + 1.5, z + 1.5}};
    }
    m_objects[m_objects.size() / 2].bounds = Bounds();
    broadPhase.update();
  }

  [[nodiscard]] std::vector<Object>& objects() { return m_objects; }

  ObjectBroadPhase<Object> broadPhase{ObjectBroadPhaseOptions()};

 private:
  std::mt19937 m_random;
  std::vector<Object> m_objects;
  unsigned m_moves = 0;
};

bool isEmpty(const Object& object) { return object.bounds.min_.x > object.bounds.max_.x; }

/// The pairs of a double loop: by the objects of the first group, or by those of the other where these are much fewer.
Pairs expectedOf(Group& first, Group& second) {
  const bool isBySecond = 8 * second.objects().size() <= first.objects().size();
  Pairs pairs;
  for (const Object& outer : (isBySecond ? second : first).objects()) {
    for (const Object& inner : (isBySecond ? first : second).objects()) {
      if (isEmpty(outer) || isEmpty(inner) || !outer.bounds.overlap(inner.bounds)) continue;
      pairs.emplace_back(isBySecond ? &inner : &outer, isBySecond ? &outer : &inner);
    }
  }
  return pairs;
}

/// The pairs that a visitor gets who ends the query with the given one, and whether it has ended.
std::pair<Pairs, bool> pairsOf(const Group& first, const Group& second, std::size_t last) {
  Pairs pairs;
  const bool isEnded = first.broadPhase.eachPairWith(second.broadPhase, [&](const Object* a, const Object* b) {
    pairs.emplace_back(a, b);
    return pairs.size() == last;
  });
  return {pairs, isEnded};
}

constexpr std::size_t kNoEnd = std::numeric_limits<std::size_t>::max();

void expectPairs(Group& first, Group& second, std::size_t last) {
  Pairs expected = expectedOf(first, second);
  const bool isEnded = last <= expected.size();
  expected.resize(std::min(expected.size(), last));
  ASSERT_EQ(pairsOf(first, second, last), std::pair(expected, isEnded)) << "ended by pair " << last;
}

class ObjectPairs : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
 protected:
  Group m_few{std::get<0>(GetParam()), 1};
  Group m_many{std::get<1>(GetParam()), 2};
};

TEST_P(ObjectPairs, AreThoseOfADoubleLoopInItsOrder) {
  for (int step = 0; step < 30; ++step) {
    expectPairs(m_few, m_many, kNoEnd);
    if (step % 16 == 15) m_many.move();
    if (step < 20) m_few.move();
  }
}

TEST_P(ObjectPairs, OfTheOtherWayRoundAreThoseOfADoubleLoopInItsOrder) {
  for (int step = 0; step < 20; ++step) {
    expectPairs(m_many, m_few, kNoEnd);
    m_few.move();
  }
}

TEST_P(ObjectPairs, EndWithTheOneThatAVisitorEnds) {
  for (const std::size_t last : {1U, 7U, 100U}) {
    for (std::size_t step = 0; step < 4; ++step) {
      expectPairs(m_few, m_many, kNoEnd);
      expectPairs(m_few, m_many, last + step);
      m_few.move();
    }
  }
}

TEST_P(ObjectPairs, GoWithObjectsThatLeaveAndReachToInfinity) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 20; ++step) {
    m_few.move();
    m_few.objects()[3].bounds = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    m_few.objects()[5].bounds = {{kInfinity, 0, 0}, {kInfinity, 9, 9}};
    m_few.broadPhase.update();
    if (step == 10) {
      m_many.objects()[7].bounds.max_ = {kInfinity, kInfinity, kInfinity};
      m_many.broadPhase.update(&m_many.objects()[7]);
    }
    expectPairs(m_few, m_many, kNoEnd);
    Object& leaving = m_few.objects()[9];
    m_few.broadPhase.remove(&leaving);
    const Bounds box = std::exchange(leaving.bounds, Bounds());
    expectPairs(m_few, m_many, kNoEnd);
    leaving.bounds = box;
    m_few.broadPhase.add(&leaving);
  }
}

TEST_P(ObjectPairs, AreTheSameForSeveralThreads) {
  for (int step = 0; step < 20; ++step) {
    m_few.move();
    const Pairs expected = expectedOf(m_few, m_many);
    std::vector<std::pair<Pairs, bool>> found(3);
    std::vector<std::thread> threads;
    threads.reserve(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t last = i == 2 && step % 4 == 3 ? 5 : kNoEnd;
      threads.emplace_back([&, i, last] { found[i] = pairsOf(m_few, m_many, last); });
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(found[0].first, expected);
    ASSERT_EQ(found[1].first, expected);
    const auto end = expected.begin() + static_cast<std::ptrdiff_t>(std::min(expected.size(), found[2].first.size()));
    ASSERT_EQ(found[2].first, Pairs(expected.begin(), found[2].second ? end : expected.end()));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ObjectPairs,
                         testing::Values(std::tuple(12, 400), std::tuple(33, 99), std::tuple(33, 256),
                                         std::tuple(56, 100), std::tuple(56, 449), std::tuple(110, 900),
                                         std::tuple(200, 300)));

}  // namespace
}  // namespace allpairs::test
