// SPDX-License-Identifier: MIT
#include "allpairs/scene/FolderNames.h"

#include <dirent.h>

#include <cerrno>
#include <memory>
#include <new>
#include <string_view>

namespace allpairs::scene {

std::vector<std::string> folderNames(const std::filesystem::path& folder, std::error_code& error) {
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
  if (!entries && errno == ENOMEM) throw std::bad_alloc();
  if (!entries) {
    error = {errno, std::generic_category()};
    return {};
  }
  std::vector<std::string> names;
  errno = 0;  // readdir() sets it where it fails
  while (const dirent* const entry = ::readdir(entries.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
    errno = 0;
  }
  if (errno == ENOMEM) throw std::bad_alloc();
  error = {errno, std::generic_category()};
  if (error) names.clear();
  return names;
}

}  // namespace allpairs::scene
