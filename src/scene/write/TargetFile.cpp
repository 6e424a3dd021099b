// SPDX-License-Identifier: MIT
#include "allpairs/scene/TargetFile.h"

#include <new>
#include <system_error>

namespace allpairs::scene {

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

}  // namespace allpairs::scene
