// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "Program.h"

namespace allpairs::test {

inline constexpr int kWrongUsage = 2;
inline constexpr int kBadInput = 3;

/// The run ended well and complained about nothing.
inline void expectSuccess(const ProgramRun& run) {
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
}

/// The run ended with this status and said why in one line that begins with the program's name and holds `part`.
inline void expectFailure(const ProgramRun& run, int status, const std::string& part) {
  EXPECT_EQ(run.status, status);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("allpairs: ")) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

}  // namespace allpairs::test
