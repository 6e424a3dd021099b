// SPDX-License-Identifier: MIT
#include "cli/SignalCleanup.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <climits>
#include <csignal>

namespace allpairs::app {
namespace {

// A signal handler sees nothing but what is global.
std::array<char, PATH_MAX> removedPath{};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t hasPath = 0;    // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

/// Calls only what is safe in a handler.
extern "C" void removeAndEnd(int signal) {
  if (hasPath != 0) ::unlink(removedPath.data());
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void removeOnSignal(const std::string& path) {
  hasPath = 0;
  if (path.empty() || path.size() >= removedPath.size()) return;
  *std::copy(path.begin(), path.end(), removedPath.begin()) = '\0';
  hasPath = 1;
}

void installSignalCleanup() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, removeAndEnd) == SIG_IGN) std::signal(signal, SIG_IGN);  // as nohup wants it
  }
}

}  // namespace allpairs::app
