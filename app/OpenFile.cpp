// SPDX-License-Identifier: MIT
#include "OpenFile.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "allpairs/Error.h"

namespace allpairs::app {
namespace {

#ifdef __APPLE__
constexpr const char* kOpener = "open";
#else
constexpr const char* kOpener = "xdg-open";
#endif

}  // namespace

void openInBrowser(const std::string& target) {
  std::string program = kOpener;
  std::string argument = target;
  const std::array<char*, 3> words{program.data(), argument.data(), nullptr};  // no shell: names are never commands
  posix_spawn_file_actions_t actions{};
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int problem = ::posix_spawnp(&child, kOpener, &actions, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (problem == 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw Error(std::string(kOpener) + " cannot open " + target + ": open it in a browser yourself");
}

}  // namespace allpairs::app
