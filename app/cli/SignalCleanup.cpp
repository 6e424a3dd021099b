// SPDX-License-Identifier: MIT
#include "cli/SignalCleanup.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <memory>
#include <utility>

namespace allpairs::app {
namespace {

/// Never freed: a signal may come at any time, on any thread.
struct Removed {
  std::string path;
  const Removed* older = nullptr;
  mutable std::atomic<bool> isSet = true;
};

/// Likewise, for which the last one knows those before it.
struct Said {
  std::string file;
  std::string line;
  const Said* older = nullptr;
};

// A signal handler sees nothing but what is global.
std::atomic<const Removed*> newest = nullptr;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<const Said*> said = nullptr;       // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<StopFlag*> stopped = nullptr;      // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<int> signalSeen = 0;               // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<const Removed*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<const Said*>::is_always_lock_free);

/// Calls only what is safe in a handler.
extern "C" void removeAndEnd(int signal) {
  if (StopFlag* const flag = stopped.exchange(nullptr)) {
    signalSeen = signal;
    flag->set();
    return;
  }
  for (const Removed* one = newest; one != nullptr; one = one->older) {
    if (one->isSet && ::unlink(one->path.c_str()) != 0) ::rmdir(one->path.c_str());
  }
  const Said* const last = said;
  if (last != nullptr && ::access(last->file.c_str(), F_OK) == 0) [[maybe_unused]]
    const auto written = ::write(STDERR_FILENO, last->line.data(), last->line.size());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void removeOnSignal(std::string path) {
  auto removed = std::make_unique<Removed>();
  removed->path = std::move(path);
  removed->older = newest;
  newest = removed.release();
}

void keepOnSignal(std::string_view path) noexcept {
  for (const Removed* one = newest; one != nullptr; one = one->older) {
    if (one->path == path) one->isSet = false;
  }
}

void sayOnSignal(std::string file, std::string line) {
  said = std::make_unique<Said>(Said{std::move(file), std::move(line), said}).release();
}

void installSignalCleanup() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, removeAndEnd) == SIG_IGN) std::signal(signal, SIG_IGN);  // as nohup wants it
  }
}

StopOnSignal::StopOnSignal() noexcept { stopped = &m_flag; }

StopOnSignal::~StopOnSignal() {
  stopped = nullptr;
  if (const int signal = signalSeen.exchange(0); signal != 0) std::raise(signal);
}

}  // namespace allpairs::app
