// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "JoinCase.h"
#include "support/Sanitizers.h"

namespace allpairs::test {

/// From one step at which a join ends to the next: all of them, but with a sanitizer every third.
inline constexpr std::size_t kStride = kIsSanitized ? 3 : 1;

/// Counts the steps of a join and calls `end` at one of them.
template <class End>
join::JoinOptions endingAt(const JoinCase& with, std::size_t step, const End& end) {
  join::JoinOptions options = with.options();
  options.resume = true;
  options.progress = [step, end, calls = std::size_t{0}](const join::JoinProgress&) mutable {
    if (calls++ == step) end();
  };
  return options;
}

/// Runs in a process of its own, which is gone at that step without a word; whether it came that far.
inline bool runKilledAt(JoinCase& with, std::size_t step) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      (void)with.run(endingAt(with, step, [] { ::_exit(9); }));
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) != 1);
  return WEXITSTATUS(status) == 9;
}

inline join::JoinOptions resuming(const JoinCase& with) {
  join::JoinOptions options = with.options();
  options.resume = true;
  return options;
}

/// Kills a join at its steps, and resumes it.
inline void expectSameBytesAfterEachKill(JoinCase& with, const std::string& expected) {
  std::size_t step = 0;
  for (; runKilledAt(with, step); step += kStride) {
    ASSERT_TRUE(with.run(resuming(with)) == expected) << step;
  }
  EXPECT_GT(step, 20U) << "steps";
}

/// Leaves a join that has found the pairs of all cells.
inline JoinCase& stoppedWhileWriting(JoinCase& with) {
  const auto failing = [](std::string_view) { throw std::runtime_error("no room"); };
  const join::ResultSink sink(failing);
  const join::JoinOptions options = with.options();
  const join::Budget budget = tinyBudget();
  join::BoxInput input(with.paths, options);
  EXPECT_THROW(join::DiskJoin(input, options, budget, false).run(&sink), std::runtime_error);
  return with;
}

}  // namespace allpairs::test
