// SPDX-License-Identifier: MIT
#include "cli/TargetFile.h"

#include <sys/stat.h>

#include <new>
#include <system_error>

namespace allpairs::app {

namespace fs = std::filesystem;

fs::path resolvedTarget(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as many as the system follows
  std::error_code problem;
  fs::path target = path;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(target, problem)); ++i) {
    target = target.parent_path() / fs::read_symlink(target);
  }
  target = fs::weakly_canonical(target, problem);
  if (problem == std::errc::not_enough_memory) throw std::bad_alloc();  // it may be a link all the same
  return target.empty() ? path : target;
}

mode_t modeOfTarget(const fs::path& target) {
  constexpr mode_t kNewFileMode = 0666;  // as any program creates files; the umask takes away what it must
  struct stat existing {};
  if (::stat(target.c_str(), &existing) == 0) return existing.st_mode & 07777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return kNewFileMode & ~mask;
}

}  // namespace allpairs::app
