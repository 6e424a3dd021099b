// SPDX-License-Identifier: MIT
#pragma once

namespace allpairs {

/// Ends the searches whose options name it: soon after it is set they throw Stopped, and so do new ones until it is cleared,
/// except those of a few boxes, which may end first. What was searching can be used on.
///
/// Cost:    a search looks at it every few milliseconds, and once in some thousand pairs. It never changes a result.
/// Threads: all members from any thread, and from a signal handler.
class StopFlag {
 public:
  StopFlag() = default;
  StopFlag(const StopFlag&) = delete;
  StopFlag& operator=(const StopFlag&) = delete;

  void set() noexcept;
  void clear() noexcept;
  [[nodiscard]] bool isSet() const noexcept;

 private:
  bool m_isSet = false;  // not std::atomic, whose header is larger than all that a search needs besides
};

}  // namespace allpairs
