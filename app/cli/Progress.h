// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <thread>

#include "cli/Timer.h"

namespace allpairs::app {

/// How far work is, as text for a line of so many columns: "frame 3 of 10  [######              ]  30 %, 7 s left".
[[nodiscard]] std::string progressText(const std::string& now, double part, double seconds, std::size_t width);

/// A line on standard error that says what long work is doing; nothing is shown unless it is a terminal.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the text, unless the work is young or another text was shown just before.
  void show(const std::string& text);

  /// Shows how much of the work is done, and how long the rest will take if it goes on like this; `now` says what is
  /// done next.
  void show(std::size_t done, std::size_t total, const std::string& now);

  /// Shows the text whatever the time.
  void showNow(const std::string& text);

  /// Takes the line away.
  void clear();

  [[nodiscard]] bool isTerminal() const { return m_isTerminal; }

 private:
  bool m_isTerminal;
  bool m_isShown = false;
  Timer m_sinceStart;
  double m_lastShown = 0.0;
};

/// A line of the same kind for work that does not say how far it is: what is done, and for how long already. It is
/// shown from a thread of its own while this lives.
class ProgressClock {
 public:
  explicit ProgressClock(std::string text);

 private:
  void run(const std::stop_token& stop, const std::string& text);

  ProgressLine m_line;
  std::jthread m_thread;  // the last member: it ends before the line does
};

}  // namespace allpairs::app
