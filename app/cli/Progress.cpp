// SPDX-License-Identifier: MIT
#include "cli/Progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <optional>
#include <utility>

#include "cli/Terminal.h"

namespace allpairs::app {
namespace {

constexpr double kInterval = 0.2;   // seconds: slow enough to read, and work that is done sooner stays silent
constexpr std::size_t kWidth = 78;  // where the terminal does not say

/// Seconds that nobody would count: 40 s, 3 min, 2 h.
std::string timeText(double seconds) {
  constexpr double kMinute = 60.0;
  constexpr double kHour = 3600.0;
  if (seconds < 2.0 * kMinute) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 2.0 * kHour) return fmt::format("{:.0f} min", std::ceil(seconds / kMinute));
  return fmt::format("{:.0f} h", std::ceil(seconds / kHour));
}

std::size_t lineWidth() {
  const std::optional<std::size_t> width = terminalWidth(STDERR_FILENO);
  return width && *width > 1 ? *width - 1 : kWidth;  // a full line would wrap
}

}  // namespace

std::string progressText(const std::string& now, double part, double seconds, std::size_t width) {
  constexpr std::size_t kBar = 20;
  constexpr double kLeastPart = 0.02;  // of the work: of less, nothing can be said of the rest
  const auto filled = static_cast<std::size_t>(part * static_cast<double>(kBar));
  std::string text = fmt::format("[{:<{}}] {:3.0f} %", std::string(filled, '#'), kBar, std::floor(100.0 * part));
  if (part >= kLeastPart && part < 1.0) text += fmt::format(", {} left", timeText(seconds / part - seconds));
  const std::size_t left = width > text.size() + 2 ? width - text.size() - 2 : 0;
  return left == 0 ? text : elided(now, left) + "  " + text;
}

ProgressLine::ProgressLine() : m_isTerminal(::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const std::string& text) {
  if (!m_isTerminal || m_sinceStart.seconds() - m_lastShown < kInterval) return;
  showNow(text);
}

void ProgressLine::show(std::size_t done, std::size_t total, const std::string& now) {
  if (!m_isTerminal || m_sinceStart.seconds() - m_lastShown < kInterval || total == 0) return;
  const double part = static_cast<double>(done) / static_cast<double>(total);
  showNow(progressText(now, part, m_sinceStart.seconds(), lineWidth()));
}

void ProgressLine::showNow(const std::string& text) {
  if (!m_isTerminal) return;
  m_lastShown = m_sinceStart.seconds();
  m_isShown = true;
  std::fprintf(stderr, "\r\033[K%s", elided(text, lineWidth()).c_str());
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (m_isShown) std::fputs("\r\033[K", stderr);
  m_isShown = false;
}

ProgressClock::ProgressClock(std::string text) {
  if (!m_line.isTerminal()) return;
  m_thread = std::jthread([this, text = std::move(text)](const std::stop_token& stop) { run(stop, text); });
}

void ProgressClock::run(const std::stop_token& stop, const std::string& text) {
  const Timer timer;
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  while (true) {
    wake.wait_for(lock, stop, std::chrono::duration<double>(kInterval), [] { return false; });
    if (stop.stop_requested()) return;
    m_line.showNow(text + ": " + std::to_string(static_cast<long>(timer.seconds())) + " s");
  }
}

}  // namespace allpairs::app
