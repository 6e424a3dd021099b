// SPDX-License-Identifier: MIT
#include "cli/Progress.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <utility>

namespace allpairs::app {
namespace {

constexpr double kInterval = 0.2;  // seconds: slow enough to read, and work that is done sooner stays silent
constexpr std::size_t kWidth = 78;

}  // namespace

ProgressLine::ProgressLine() : m_isTerminal(::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const std::string& text) {
  if (!m_isTerminal || m_sinceStart.seconds() - m_lastShown < kInterval) return;
  showNow(text);
}

void ProgressLine::showNow(const std::string& text) {
  if (!m_isTerminal) return;
  m_lastShown = m_sinceStart.seconds();
  m_isShown = true;
  std::fprintf(stderr, "\r\033[K%s", text.substr(0, kWidth).c_str());
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
