// SPDX-License-Identifier: MIT
#include "allpairs/scene/TargetFile.h"

#include <fcntl.h>
#include <unistd.h>

#include <exception>
#include <new>
#include <system_error>

#include "allpairs/scene/FileError.h"

namespace allpairs::scene {

namespace fs = std::filesystem;

fs::path resolvedTarget(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as many as the system follows
  std::error_code problem;
  fs::path target = path;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(target, problem)); ++i) {
    const fs::path next = fs::read_symlink(target, problem);
    if (problem) throw FileError::ofSystem(path, "cannot be followed", problem);
    target = target.parent_path() / next;
  }
  target = fs::weakly_canonical(target, problem);
  if (problem == std::errc::not_enough_memory) throw std::bad_alloc();  // it may be a link all the same
  if (problem == std::errc::too_many_symbolic_link_levels) {
    throw FileError(path, "is a link that leads nowhere", problem);
  }
  return target.empty() ? path : target;
}

void syncNameOf(const fs::path& file) noexcept {
  try {
    const fs::path folder = resolvedTarget(file).parent_path();
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
  } catch (const std::exception&) {  // the file has its name, which may be lost with the power
    return;
  }
}

void checkIsNoInput(const fs::path& output, Span<const fs::path> inputs) {
  std::error_code ignored;  // a file that is not there is none, or is refused when it is read
  if (!fs::is_regular_file(output, ignored)) return;
  for (const fs::path& input : inputs) {
    if (fs::equivalent(input, output, ignored)) throw FileError(output, "is an input; the output needs another name");
  }
}

}  // namespace allpairs::scene
