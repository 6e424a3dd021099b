// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "Timer.h"

namespace allpairs::app {

/// A line on standard error that says what long work is doing; nothing is shown unless it is a terminal.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the text, unless the work is young or another text was shown just before.
  void show(const std::string& text);

  /// Shows the text whatever the time.
  void showNow(const std::string& text);

  /// Takes the line away.
  void clear();

 private:
  bool m_isTerminal;
  bool m_isShown = false;
  Timer m_sinceStart;
  double m_lastShown = 0.0;
};

}  // namespace allpairs::app
