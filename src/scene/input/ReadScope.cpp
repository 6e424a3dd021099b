// SPDX-License-Identifier: MIT
#include "input/ReadScope.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>

#include "allpairs/scene/FileError.h"

namespace allpairs::scene {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMissing = "is nowhere to be found; --data DIR says where else to look";
constexpr const char* kSpecial = "is not a regular file";

/// The folder whose files an input may name: itself, where it is one.
fs::path folderOf(const fs::path& input) {
  std::error_code ignored;
  if (fs::is_directory(input, ignored)) return input;
  return input.has_parent_path() ? input.parent_path() : fs::path(".");
}

bool isBelow(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// Whether a name may lead out of the folder that it begins in, even without symbolic links.
bool mayLeave(const fs::path& name) {
  return name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end();
}

std::string bytesText(std::uint64_t bytes) {
  static constexpr std::array<const char*, 5> kUnits{" bytes", " KiB", " MiB", " GiB", " TiB"};
  std::size_t unit = 0;
  for (; bytes >= std::uint64_t{10} * 1024 && unit + 1 < kUnits.size(); ++unit) bytes /= 1024;
  return std::to_string(bytes) + (bytes == 1 && unit == 0 ? " byte" : kUnits[unit]);
}

}  // namespace

std::uint64_t halfOfMemory() noexcept {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long pageSize = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || pageSize <= 0) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageSize) / 2;
}

ReadScope::ReadScope(const fs::path& input, const ReadOptions& options)
    : m_input(input),
      m_searchRoots(options.searchRoots),
      m_allowOutside(options.allowOutside),
      m_maxMemory(options.maxMemory),
      m_stop(options.stop) {
  std::error_code problem;
  m_folders.push_back(fs::canonical(folderOf(input), problem));
  for (const fs::path& root : options.searchRoots) m_folders.push_back(fs::canonical(root, problem));
  std::erase_if(m_folders, [](const fs::path& folder) { return folder.empty(); });  // one that is not there
  m_limit = limit();
}

ReadScope::Found ReadScope::find(std::string_view name, const fs::path& namedIn) const {
  std::string portable(name);
  std::replace(portable.begin(), portable.end(), '\\', '/');
  const fs::path wanted(portable);
  if (wanted.empty()) return {{}, kMissing};
  std::vector<fs::path> candidates{namedIn.parent_path() / wanted};  // an absolute name stands alone
  if (!wanted.is_absolute()) {
    for (const fs::path& root : m_searchRoots) candidates.push_back(root / wanted);
  }
  const char* problem = kMissing;
  for (const fs::path& candidate : candidates) {
    std::error_code ignored;
    if (mayLeave(wanted) && !allows(candidate)) {
      problem = ReadScope::kOutside;
    } else if (fs::exists(candidate, ignored)) {
      const bool isAllowed = allows(candidate);
      if (isAllowed && fs::is_regular_file(candidate, ignored)) return {candidate, {}};
      problem = isAllowed ? kSpecial : ReadScope::kOutside;
    }
  }
  return {{}, problem};
}

bool ReadScope::allows(const fs::path& file) const {
  if (m_allowOutside) return true;
  std::error_code problem;
  const fs::path resolved = fs::weakly_canonical(fs::absolute(file, problem), problem);
  if (problem) return false;
  return std::any_of(m_folders.begin(), m_folders.end(),
                     [&resolved](const fs::path& folder) { return isBelow(resolved, folder); });
}

void ReadScope::admit(const fs::path& file) {
  std::error_code problem;
  const std::uint64_t size = fs::file_size(file, problem);
  if (problem) return;  // opening it reports the problem
  if (m_files.insert(fs::weakly_canonical(file, problem)).second) {
    m_bytes += size;
    m_limit = limit();
  }
  take(size);
}

std::uint64_t ReadScope::limit() const {
  if (m_maxMemory != 0) return m_maxMemory;
  constexpr std::uint64_t kMost = (UINT64_MAX - kFreeBytes) / kBytesPerByte;
  static const std::uint64_t half = halfOfMemory();
  return std::min(half, kFreeBytes + kBytesPerByte * std::min(m_bytes, kMost));
}

void ReadScope::refuse() const {
  const std::string what = "takes more than " + bytesText(m_limit) + " of memory to read, ";
  if (m_maxMemory != 0) throw FileError(m_input, what + "which is what --max-memory allows");
  throw FileError(m_input, what + "the most for " + bytesText(m_bytes) + " of files; --max-memory allows more");
}

}  // namespace allpairs::scene
