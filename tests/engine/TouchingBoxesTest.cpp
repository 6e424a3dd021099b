// SPDX-License-Identifier: MIT
// Boxes as they lie in memory against one box, and the search for NaNs among numbers, for every count around whole vectors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "kernels/Kernels.h"

namespace allpairs::engine {
namespace {

/// More than three vectors of the widest instruction set.
constexpr std::size_t kMostBoxes = 53;

/// Small whole numbers, so that faces touch, boxes are flat or empty, and some bounds are infinite.
template <class T>
std::vector<T> gridRows(std::size_t boxes, std::mt19937& generator) {
  std::vector<T> rows(6 * boxes);
  for (std::size_t i = 0; i < boxes; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      T& min = rows[6 * i + axis];
      T& max = rows[6 * i + axis + 3];
      min = static_cast<T>(generator() % 9) - 4;
      max = min + static_cast<T>(generator() % 5);
      if (generator() % 40 == 0) min = -std::numeric_limits<T>::infinity();
      if (generator() % 40 == 0) max = std::numeric_limits<T>::infinity();
      if (generator() % 40 == 0) max = min - 1;
    }
  }
  return rows;
}

template <class T>
std::vector<std::uint32_t> touchingInLoop(std::span<const T> rows, const std::array<T, 6>& box) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < rows.size() / 6; ++i) {
    bool touches = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const T min = rows[6 * i + axis];
      const T max = rows[6 * i + axis + 3];
      if (min > max || min > box[axis + 3] || max < box[axis]) touches = false;
    }
    if (touches) numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return numbers;
}

template <class T>
std::vector<std::uint32_t> touching(const PlainKernels<T>& kernels, const BoxRun<T>& run, const std::array<T, 6>& box) {
  std::vector<std::uint32_t> numbers(run.size + kVectorSlack);
  numbers.resize(kernels.touchingBoxes(run, box, numbers.data()));
  return numbers;
}

/// Rows of six, and two arrays of corners; the arrays end where the boxes do.
template <class T>
void expectTouching(const PlainKernels<T>& kernels, std::span<const T> rows, const std::array<T, 6>& box) {
  const std::size_t size = rows.size() / 6;
  const std::vector<std::uint32_t> expected = touchingInLoop(rows, box);
  const std::vector<T> together(rows.begin(), rows.end());
  std::vector<T> min;
  std::vector<T> max;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min.push_back(rows[6 * i + axis]);
      max.push_back(rows[6 * i + axis + 3]);
    }
  }
  if (size == 0) return;
  ASSERT_EQ(touching(kernels, {together.data(), together.data() + 3, 6, size}, box), expected) << size << " rows";
  ASSERT_EQ(touching(kernels, {min.data(), max.data(), 3, size}, box), expected) << size << " corners";
}

class TouchingBoxes : public ::testing::TestWithParam<std::string_view> {
 protected:
  template <class T>
  void compareEveryCount() const {
    std::mt19937 generator(9);
    for (std::size_t size = 1; size <= kMostBoxes; ++size) {
      for (int round = 0; round < 12; ++round) {
        const std::vector<T> rows = gridRows<T>(size, generator);
        std::array<T, 6> box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box[axis] = static_cast<T>(generator() % 9) - 4 - static_cast<T>(round);  // Later ones touch all boxes.
          box[axis + 3] = box[axis] + static_cast<T>(generator() % 5) + static_cast<T>(2 * round);
        }
        ASSERT_NO_FATAL_FAILURE(expectTouching<T>(m_kernels.plain<T>(), rows, box));
      }
    }
  }

  template <class T>
  void compareNans() const {
    const auto anyNan = m_kernels.plain<T>().anyNan;
    for (std::size_t size = 0; size <= 70; ++size) {
      std::vector<T> values(size, std::numeric_limits<T>::infinity());
      ASSERT_FALSE(anyNan(values.data(), size)) << size << " values";
      for (T& value : values) {
        value = std::numeric_limits<T>::quiet_NaN();
        ASSERT_TRUE(anyNan(values.data(), size)) << size << " values";
        value = T{0};
      }
    }
  }

  const Kernels& m_kernels = *findKernels(GetParam());
};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, TouchingBoxes,
                         ::testing::ValuesIn(kernelNames().begin(), kernelNames().end()));

TEST_P(TouchingBoxes, OfFloat32AreThoseOfTheLoop) { compareEveryCount<float>(); }
TEST_P(TouchingBoxes, OfFloat64AreThoseOfTheLoop) { compareEveryCount<double>(); }

TEST_P(TouchingBoxes, ANanIsFoundWhereverItIs) {
  compareNans<float>();
  compareNans<double>();
}

}  // namespace
}  // namespace allpairs::engine
