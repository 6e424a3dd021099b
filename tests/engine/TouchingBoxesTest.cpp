// SPDX-License-Identifier: MIT
// Boxes as they lie in memory against one box, and the search for NaNs among numbers, for every count around whole
// vectors.
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

/// More than two words of bits, and three vectors of the widest instruction set.
constexpr std::size_t kMostBoxes = 133;

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

/// The numbers of the bits that are set, in words of so many.
std::vector<std::uint32_t> numbersOf(const std::vector<std::uint64_t>& words) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < 64 * words.size(); ++i) {
    if ((words[i / 64] >> (i % 64) & 1U) != 0) numbers.push_back(i);
  }
  return numbers;
}

template <class T>
std::vector<std::uint32_t> touching(const PlainKernels<T>& kernels, const BoxRun<T>& run, const std::array<T, 6>& box) {
  std::vector<std::uint64_t> words((run.size + 63) / 64, ~std::uint64_t{0});
  kernels.touchBoxes(run, box, words.data());
  return numbersOf(words);
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
      for (int round = 0; round < 6; ++round) {
        const std::vector<T> rows = gridRows<T>(size, generator);
        std::array<T, 6> box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box[axis] = static_cast<T>(generator() % 9) - 4 - static_cast<T>(2 * round);  // Later ones touch all boxes.
          box[axis + 3] = box[axis] + static_cast<T>(generator() % 5) + static_cast<T>(4 * round);
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

/// Pairs of boxes from 1000 on with others from 50 on, of words of bits for each of the others.
std::vector<Pair> pairsInLoop(const std::vector<std::vector<std::uint64_t>>& words, std::size_t size,
                              bool othersSecond) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < size; ++i) {
    for (std::uint32_t k = 0; k < words.size(); ++k) {
      if ((words[k][i / 64] >> (i % 64) & 1U) == 0) continue;
      pairs.push_back(othersSecond ? Pair{1000 + i, 50 + k} : Pair{50 + k, 1000 + i});
    }
  }
  return pairs;
}

TEST_P(TouchingBoxes, OfAnyNumberOfOthersGiveAllPairsInOrder) {
  std::mt19937_64 generator(10);
  for (std::size_t others = 1; others <= kMostOthers; ++others) {
    for (const std::size_t size : {1U, 7U, 63U, 64U, 65U, 200U}) {
      for (const std::uint64_t share : {1U, 3U, 40U}) {
        std::vector<std::vector<std::uint64_t>> words(others, std::vector<std::uint64_t>((size + 63) / 64));
        TouchedBoxes touched{{}, size, others, 1000, 50};
        for (std::size_t k = 0; k < others; ++k) {
          touched.words[k] = words[k].data();
          for (std::size_t i = 0; i < size; ++i) {
            words[k][i / 64] |= std::uint64_t{generator() % share == 0 ? 1U : 0U} << (i % 64);
          }
        }
        for (const bool othersSecond : {true, false}) {
          std::vector<Pair> pairs(size * others + kVectorSlack);
          pairs.resize(m_kernels.writeTouching(touched, othersSecond, pairs.data()));
          ASSERT_TRUE(pairs == pairsInLoop(words, size, othersSecond)) << size << " boxes, " << others << " others";
        }
      }
    }
  }
}

TEST_P(TouchingBoxes, ANanIsFoundWhereverItIs) {
  compareNans<float>();
  compareNans<double>();
}

}  // namespace
}  // namespace allpairs::engine
