// SPDX-License-Identifier: MIT
#include "view/OpenFile.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "allpairs/Error.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

#ifdef __APPLE__
constexpr const char* kOpener = "open";
#else
constexpr const char* kOpener = "xdg-open";
#endif

/// Starts the opener, without output on the terminal; returns 0, or why it did not start.
int start(const std::string& target, pid_t& child) {
  std::string program = kOpener;
  std::string argument = target;
  const std::array<char*, 3> words{program.data(), argument.data(), nullptr};  // no shell: names are never commands
  posix_spawn_file_actions_t actions{};
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes{};
  sigset_t signals{};
  ::sigemptyset(&signals);
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::sigaddset(&signals, signal);  // which this program ignores
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigdefault(&attributes, &signals);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int problem = ::posix_spawnp(&child, kOpener, &actions, &attributes, words.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return problem;
}

/// Whether it ended at once with a failure. One that keeps running is the browser itself, which is not waited for.
bool hasFailed(pid_t child) {
  constexpr std::chrono::milliseconds kPatience{2000};
  constexpr std::chrono::milliseconds kStep{20};
  int status = 0;
  for (auto waited = kStep; waited < kPatience; waited += kStep) {
    if (::waitpid(child, &status, WNOHANG) == child) return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
    std::this_thread::sleep_for(kStep);
  }
  return false;
}

}  // namespace

void openInBrowser(const std::string& target) {
  const std::string advice = ": open " + target + " in a browser yourself";
  pid_t child = 0;
  const int problem = start(target, child);
  if (problem == ENOENT) throw Error(std::string("there is no ") + kOpener + " here" + advice);
  if (problem != 0 || hasFailed(child)) throw Error(std::string(kOpener) + " found no way to open it" + advice);
}

void tryToOpen(const std::string& target) {
  try {
    openInBrowser(target);
  } catch (const Error& problem) {
    fmt::print(stderr, "allpairs: {}\n", printable(problem.what()));
  }
}

}  // namespace allpairs::app
