// SPDX-License-Identifier: MIT
#include "cli/TargetFile.h"

#include <sys/stat.h>

namespace allpairs::app {

mode_t modeOfTarget(const std::filesystem::path& target) {
  constexpr mode_t kNewFileMode = 0666;  // as any program creates files; the umask takes away what it must
  struct stat existing {};
  if (::stat(target.c_str(), &existing) == 0) return existing.st_mode & 07777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return kNewFileMode & ~mask;
}

}  // namespace allpairs::app
