// SPDX-License-Identifier: MIT
#include "Samples.h"

#include <gtest/gtest.h>

#include "Sampling.h"

namespace {

using allpairs::measure::Duration;
using allpairs::measure::Effort;
using allpairs::measure::median;
using allpairs::measure::Samples;
using allpairs::measure::Sampling;
using allpairs::measure::Summary;

TEST(Samples, MedianIsTheMiddleOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(median({3.0}), 3.0);
  EXPECT_EQ(median({5.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({8.0, 1.0, 2.0, 4.0}), 3.0);
}

TEST(Samples, SummaryHoldsMediansAndTheSpread) {
  Samples samples;
  samples.add({.wallMs = 4.0, .cpuMs = 3.0});
  samples.add({.wallMs = 2.0, .cpuMs = 1.0});
  samples.add({.wallMs = 9.0, .cpuMs = 2.0});
  const Summary summary = samples.summary();
  EXPECT_EQ(summary.repetitions, 3U);
  EXPECT_EQ(summary.medianMs, 4.0);
  EXPECT_EQ(summary.medianCpuMs, 2.0);
  EXPECT_EQ(summary.minMs, 2.0);
  EXPECT_EQ(summary.maxMs, 9.0);
}

/// A clock that says each run takes so long, and counts the runs.
struct SlowThing {
  double runMs = 1.0;
  std::size_t runs = 0;

  Duration operator()(std::size_t more) {
    runs += more;
    return {.wallMs = runMs, .cpuMs = runMs};
  }
};

TEST(Sampling, TakesAsManySamplesAsTheTimeAllows) {
  const Sampling sampling(SlowThing{.runMs = 10.0}, {.seconds = 1.0, .fewestSamples = 3, .mostSamples = 200});
  EXPECT_EQ(sampling.allowance(), 100U);
}

TEST(Sampling, TakesAFewSamplesOfWhatIsTooSlow) {
  const Sampling sampling(SlowThing{.runMs = 5000.0}, {.seconds = 1.0, .fewestSamples = 3, .mostSamples = 200});
  EXPECT_EQ(sampling.allowance(), 3U);
}

TEST(Sampling, RepeatsShortRunsWithinASample) {
  SlowThing thing{.runMs = 0.01};
  Sampling sampling(std::ref(thing), {.seconds = 1.0, .shortestSampleMs = 1.0, .mostSamples = 200});
  const std::size_t trials = thing.runs;
  sampling.take();
  EXPECT_EQ(thing.runs - trials, 100U);
  EXPECT_EQ(sampling.allowance(), 200U);
  EXPECT_EQ(sampling.summary().medianMs, 0.01);
}

}  // namespace
