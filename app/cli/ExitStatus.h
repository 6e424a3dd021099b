// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace allpairs::app {

/// What the program says to the shell when it ends, unless a signal ends it. The manual page lists all.
enum class ExitStatus : int {
  Success = 0,
  Difference = 1,    ///< --verify found that two strategies disagree.
  WrongUsage = 2,    ///< An option or argument that makes no sense.
  BadInput = 3,      ///< A file that can't be read, understood or written.
  Found = 4,         ///< What --fail-on names was found.
  ClosedPipe = 141,  ///< The reader of the output has gone: what a shell reports for SIGPIPE.
};

/// A command line that makes no sense.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What --fail-on names was found: after all output is written.
class Found : public std::runtime_error {
 public:
  explicit Found(const std::string& what) : std::runtime_error("--fail-on: found " + what) {}
};

/// Nobody reads the output any more.
class ClosedPipe : public std::runtime_error {
 public:
  ClosedPipe() : std::runtime_error("the output is closed") {}
};

}  // namespace allpairs::app
