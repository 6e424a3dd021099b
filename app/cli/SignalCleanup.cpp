// SPDX-License-Identifier: MIT
#include "cli/SignalCleanup.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <climits>
#include <csignal>
#include <cstddef>

namespace allpairs::app {
namespace {

// A signal handler sees nothing but what is global.
struct Removed {
  std::array<char, PATH_MAX> path{};
  volatile std::sig_atomic_t isSet = 0;
};
constexpr std::size_t kSlots = 3;
std::array<Removed, kSlots> removed{};  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

/// Calls only what is safe in a handler.
extern "C" void removeAndEnd(int signal) {
  for (const Removed& one : removed) {
    if (one.isSet != 0 && ::unlink(one.path.data()) != 0) ::rmdir(one.path.data());
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void removeOnSignal(const std::string& path, SignalSlot slot) {
  Removed& one = removed[static_cast<std::size_t>(slot)];
  one.isSet = 0;
  if (path.empty() || path.size() >= one.path.size()) return;
  *std::copy(path.begin(), path.end(), one.path.begin()) = '\0';
  one.isSet = 1;
}

void installSignalCleanup() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, removeAndEnd) == SIG_IGN) std::signal(signal, SIG_IGN);  // as nohup wants it
  }
}

}  // namespace allpairs::app
