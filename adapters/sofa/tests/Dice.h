// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>

#include <random>

namespace allpairs::test {

/// A model with a rule of its own: it collides with what has an odd number of groups.
class OddGroups : public sofa::core::CollisionModel {
 public:
  bool canCollideWith(sofa::core::CollisionModel* other) override { return other->getGroups().size() % 2 != 0; }
};

/// Draws scenes; everything is a small integer or a quarter of one, so that boxes often just touch.
class Dice {
 public:
  explicit Dice(unsigned seed) : m_engine(seed) {}

  int upTo(int most) { return std::uniform_int_distribution<int>(0, most)(m_engine); }
  bool oneIn(int n) { return upTo(n - 1) == 0; }
  double quarter(int most) { return 0.25 * upTo(most); }
  std::mt19937& engine() { return m_engine; }

 private:
  std::mt19937 m_engine;
};

}  // namespace allpairs::test
