// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "allpairs/FunctionRef.h"

namespace allpairs {

/// Ends the searches whose options name it: soon after it is set they throw Stopped, and so do new ones until it is
/// cleared, except those of a few boxes, which may end first. What was searching can be used on.
///
/// Cost:    a search looks at it every few hundredths of a second, once in some thousand pairs, and between two batches
///          of a stream. It never changes a result.
/// Threads: all members from any thread, and from a signal handler.
class StopFlag {
 public:
  StopFlag() = default;

  /// A flag that also counts as set when `ask` returns true, for a program in which no other thread can set it, or for
  /// a time limit. A search asks whenever it looks at the flag, in the thread that looks: one with an executor on
  /// several at once. What is asked must outlive the flag and may not throw.
  explicit StopFlag(FunctionRef<bool()> ask) noexcept : m_ask(ask) {}

  StopFlag(const StopFlag&) = delete;
  StopFlag& operator=(const StopFlag&) = delete;

  void set() noexcept;
  void clear() noexcept;
  [[nodiscard]] bool isSet() const noexcept;

 private:
  std::optional<FunctionRef<bool()>> m_ask;
  bool m_isSet = false;  // not std::atomic, whose header is larger than all that a search needs besides
};

/// Throws Stopped if there is a flag and it is set.
void checkStop(const StopFlag* stop);

}  // namespace allpairs
