// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <map>
#include <random>
#include <vector>

#include "allpairs/World.h"
#include "allpairs/objects/ObjectNumbers.h"

namespace allpairs::test {
namespace {

TEST(ObjectNumbers, AreThoseOfAMapAfterAnyCalls) {
  std::vector<std::array<double, 10>> memory(400);  // objects lie at even distances, as in the arrays of programs
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    ObjectNumbers numbers;
    std::map<const void*, BoxId> expected;
    const std::size_t used = std::size_t{3} << (seed % 8);
    for (BoxId call = 0; call < 3000; ++call) {
      const void* const object = &memory[random() % used];
      const auto known = expected.find(object);
      ASSERT_EQ(numbers.find(object), known == expected.end() ? kNoBox : known->second);
      if (known != expected.end()) {
        numbers.erase(object);
        expected.erase(known);
      } else {
        numbers.insert(object, call);
        expected[object] = call;
      }
      ASSERT_EQ(numbers.size(), expected.size());
      if (call % 64 != 0) continue;
      for (const auto& [other, number] : expected) ASSERT_EQ(numbers.find(other), number) << "seed " << seed;
    }
  }
}

TEST(ObjectNumbers, NothingHasNone) {
  ObjectNumbers numbers;
  EXPECT_EQ(numbers.find(nullptr), kNoBox);
  numbers.insert(nullptr, 3);
  EXPECT_EQ(numbers.find(nullptr), kNoBox);
  EXPECT_EQ(numbers.size(), 0U);
}

}  // namespace
}  // namespace allpairs::test
