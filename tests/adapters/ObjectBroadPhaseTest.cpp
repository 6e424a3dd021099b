// SPDX-License-Identifier: MIT
#include "allpairs/objects/ObjectBroadPhase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

#include "PlainObject.h"

namespace allpairs::test {
namespace {

constexpr double kMost = std::numeric_limits<double>::max();
constexpr double kEnd = std::numeric_limits<double>::infinity();

using Objects = std::set<const Object*>;

/// The row of objects along x, every second one of which reaches to infinity.
class ObjectsToInfinity : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    m_objects.resize(GetParam());
    for (std::size_t i = 0; i < m_objects.size(); ++i) {
      const double x = 3.0 * static_cast<double>(i);
      m_objects[i].bounds = {{x, 0, 0}, {i % 2 == 0 ? x + 1.0 : kEnd, 1, 1}};
      m_broadPhase.add(&m_objects[i]);
      if (i % 2 != 0) m_endless.insert(&m_objects[i]);
    }
  }

  std::vector<Object> m_objects;
  Objects m_endless;
  ObjectBroadPhase<Object> m_broadPhase{ObjectBroadPhaseOptions()};
};

TEST_P(ObjectsToInfinity, AreOverlappedAndNearWhereItIs) {
  const Object there{{{kEnd, 0, 0}, {kEnd, 1, 1}}};
  for (int query = 0; query < 100; ++query) {  // of many, a hierarchy is made after some
    Objects overlapping;
    m_broadPhase.eachOverlapping(there, [&](const Object* found) {
      overlapping.insert(found);
      return false;
    });
    ASSERT_EQ(overlapping, m_endless);
    for (const double within : {kMost, kEnd, 5.0}) {
      double least = within;
      Objects near;
      m_broadPhase.eachNear(
          there,
          [&](const Object* found, double&) {
            EXPECT_TRUE(near.insert(found).second);
            return false;
          },
          least);
      ASSERT_TRUE(std::includes(near.begin(), near.end(), m_endless.begin(), m_endless.end())) << within;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Numbers, ObjectsToInfinity, testing::Values(5, 20, 100, 200, 400));

}  // namespace
}  // namespace allpairs::test
