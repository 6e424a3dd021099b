// SPDX-License-Identifier: MIT
#include "mesh/assimp/ChildProcess.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>

namespace allpairs::scene {
namespace {

constexpr int kMillisecondsOfPatience = 50;  // between two calls of beforeReading() while nothing comes

constexpr char kComplete = 'C';  // stands behind what the child has written in full

struct Pipe {
  std::array<int, 2> ends{-1, -1};

  Pipe() {
    if (::pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "a pipe");
    for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  ~Pipe() {
    closeEnd(0);
    closeEnd(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  Pipe(Pipe&&) = delete;
  Pipe& operator=(Pipe&&) = delete;

  void closeEnd(std::size_t which) {
    if (ends[which] >= 0) ::close(ends[which]);
    ends[which] = -1;
  }
};

/// The child, which is gone with this object.
class Child {
 public:
  explicit Child(pid_t process) : m_process(process) {}
  ~Child() {
    ::kill(m_process, SIGKILL);
    while (::waitpid(m_process, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  Child(Child&&) = delete;
  Child& operator=(Child&&) = delete;

 private:
  pid_t m_process;
};

template <class Resource>
void limit(Resource resource, std::uint64_t most) {
  rlimit old{};
  if (::getrlimit(resource, &old) != 0) return;
  const rlim_t value = std::min<rlim_t>(static_cast<rlim_t>(most), old.rlim_max);
  const rlimit wanted{value, value};
  ::setrlimit(resource, &wanted);
}

/// The address space that this process has; 0 where the system does not say.
std::uint64_t addressSpace() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Nothing that the child does reaches the terminal, the parent's handlers of signals, or a file of its memory.
void isolate(const ChildLimits& limits) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    std::signal(signal, SIG_DFL);
  }
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpuSeconds);
  const std::uint64_t before = addressSpace();
  if (before != 0 && limits.memory < UINT64_MAX - before) limit(RLIMIT_AS, before + limits.memory);
}

bool writeAll(int descriptor, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(descriptor, bytes, count);
    if (written < 0 && errno != EINTR) return false;
    if (written < 0) continue;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

[[noreturn]] void runAndEnd(const std::function<std::string()>& work, const ChildLimits& limits, int target) {
  try {
    isolate(limits);
    const std::string result = work();
    if (writeAll(target, result.data(), result.size())) writeAll(target, &kComplete, 1);
  } catch (...) {  // whatever it was, the parent sees that nothing came
  }
  ::_exit(0);
}

std::string readAll(int source, const std::function<void(std::uint64_t)>& beforeReading) {
  constexpr std::size_t kPiece = 1 << 16;
  std::string text;
  while (true) {
    beforeReading(kPiece);
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    pollfd waited{source, POLLIN, 0};
    while (::poll(&waited, 1, kMillisecondsOfPatience) == 0) beforeReading(0);
    const ssize_t count = ::read(source, text.data() + before, kPiece);
    text.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

}  // namespace

std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits,
                       const std::function<void(std::uint64_t)>& beforeReading) {
  Pipe pipe;
  const pid_t process = ::fork();
  if (process < 0) throw std::bad_alloc();
  if (process == 0) runAndEnd(work, limits, pipe.ends[1]);
  const Child child(process);
  pipe.closeEnd(1);
  std::string text = readAll(pipe.ends[0], beforeReading);
  if (!text.ends_with(kComplete)) return {};
  text.pop_back();
  return text;
}

}  // namespace allpairs::scene
