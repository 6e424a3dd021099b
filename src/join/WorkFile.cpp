// SPDX-License-Identifier: MIT
#include "WorkFile.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "Checksum.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::join {

namespace {

int opened(const std::filesystem::path& path, WorkFile::Mode mode) {
  constexpr mode_t kPermissions = 0666;  // less what the umask takes away
  int flags = O_RDWR | O_CLOEXEC;
  if (mode == WorkFile::Mode::CreateOrOpen) flags |= O_CREAT | O_NOFOLLOW;
  if (mode == WorkFile::Mode::Create) {
    flags |= O_CREAT | O_EXCL;
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) return -1;
  }
  return ::open(path.c_str(), flags, kPermissions);
}

}  // namespace

WorkFile::WorkFile(const std::filesystem::path& path, Mode mode) : m_path(path), m_descriptor(opened(path, mode)) {
  if (m_descriptor < 0) fail("opened");
}

std::optional<WorkFile> WorkFile::unlessFolderIsGone(const std::filesystem::path& path) {
  WorkFile file;
  file.m_path = path;
  file.m_descriptor = opened(path, Mode::CreateOrOpen);
  if (file.m_descriptor < 0 && errno == ENOENT) return std::nullopt;
  if (file.m_descriptor < 0) file.fail("opened");
  return file;
}

WorkFile::~WorkFile() {
  if (m_descriptor >= 0) ::close(m_descriptor);
}

WorkFile::WorkFile(WorkFile&& other) noexcept
    : m_path(std::move(other.m_path)), m_descriptor(std::exchange(other.m_descriptor, -1)) {}

WorkFile& WorkFile::operator=(WorkFile&& other) noexcept {
  std::swap(m_path, other.m_path);
  std::swap(m_descriptor, other.m_descriptor);
  return *this;
}

bool WorkFile::setPermissions(std::filesystem::perms permissions) const noexcept {
  return ::fchmod(m_descriptor, static_cast<mode_t>(permissions)) == 0;
}

void WorkFile::write(std::uint64_t position, const void* bytes, std::size_t count) const {
  const char* next = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(m_descriptor, next, count, static_cast<off_t>(position));
    if (written < 0 && errno == EINTR) continue;
    if (written == 0) errno = ENOSPC;
    if (written <= 0) fail("written");
    next += written;
    position += static_cast<std::uint64_t>(written);
    count -= static_cast<std::size_t>(written);
  }
}

void WorkFile::read(std::uint64_t position, void* bytes, std::size_t count) const {
  char* next = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t done = ::pread(m_descriptor, next, count, static_cast<off_t>(position));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("read");
    if (done == 0) throw FileError(m_path, "ends too early");
    next += done;
    position += static_cast<std::uint64_t>(done);
    count -= static_cast<std::size_t>(done);
  }
}

void WorkFile::sync() const {
  if (::fsync(m_descriptor) != 0) fail("written");
}

bool WorkFile::lock() const {
  if (::flock(m_descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  fail("locked");
}

bool WorkFile::isThere() const {
  struct stat own {};
  struct stat there {};
  return ::fstat(m_descriptor, &own) == 0 && ::stat(m_path.c_str(), &there) == 0 && own.st_dev == there.st_dev &&
         own.st_ino == there.st_ino;
}

void WorkFile::fail(const char* action) const {
  const std::error_code code(errno, std::generic_category());
  throw FileError::ofSystem(m_path, std::string("cannot be ") + action, code);
}

bool isAbsent(const std::filesystem::path& path) noexcept {
  std::error_code unknown;
  return !std::filesystem::exists(path, unknown) && !unknown;
}

std::optional<std::uint64_t> checksumOf(const WorkFile& file, std::uint64_t position, std::uint64_t count,
                                        const StopFlag* stop) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 20;
  Checksum checksum;
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::min<std::uint64_t>(count, kAtOnce)));
  try {
    while (count > 0) {
      checkStop(stop);
      const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(count, bytes.size()));
      file.read(position, bytes.data(), part);
      checksum.add(bytes.data(), part);
      position += part;
      count -= part;
    }
  } catch (const FileError&) {
    return std::nullopt;
  }
  return checksum.value();
}

}  // namespace allpairs::join
