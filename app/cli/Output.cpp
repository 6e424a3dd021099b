// SPDX-License-Identifier: MIT
#include "cli/Output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "allpairs/scene/TargetFile.h"
#include "cli/ExitStatus.h"
#include "cli/SignalCleanup.h"
#include "cli/TargetFile.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

namespace fs = std::filesystem;

std::string descriptorPath(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// The descriptor of this program that a path such as /dev/stdout or /dev/fd/3 means.
std::optional<int> ownDescriptor(const fs::path& path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  if (path.parent_path() != "/dev/fd" && path.parent_path() != "/proc/self/fd") return std::nullopt;
  const auto descriptor = numberOf<int>(path.filename().string());
  return descriptor && *descriptor >= 0 ? descriptor : std::nullopt;
}

/// Where a temporary name begins: with that of the file, unless what follows would make it too long.
fs::path besideOf(const fs::path& place) {
  constexpr std::size_t kMost = 200;  // of 255
  return place.parent_path() / place.filename().string().substr(0, kMost);
}

/// A file without a name in the folder of `place`; below 0 where the system has no such files, or couldn't name them.
int openNameless([[maybe_unused]] const fs::path& place) {
#ifdef O_TMPFILE
  const std::string folder = place.has_parent_path() ? place.parent_path().string() : ".";
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (descriptor < 0 || ::access(descriptorPath(descriptor).c_str(), F_OK) == 0) return descriptor;
  ::close(descriptor);
#endif
  return -1;
}

}  // namespace

/// What the first constructor has made is destroyed where the second one throws.
Output::Output(const std::optional<fs::path>& path) : Output() {
  if (!path) {
    m_descriptor = STDOUT_FILENO;
    return;
  }
  m_target = *path;
  openTarget();
}

void Output::openTarget() {
  if (const std::optional<int> own = ownDescriptor(m_target)) {
    m_descriptor = ::fcntl(*own, F_DUPFD_CLOEXEC, 0);
    if (m_descriptor < 0) fail("opened for writing");
    return;
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(m_target, ignored);
  if (fs::is_directory(status)) throw FileError(m_target, "is a folder; -o takes a file");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    m_descriptor = ::open(m_target.c_str(), O_WRONLY | O_CLOEXEC);
    if (m_descriptor < 0) fail("opened for writing");
    return;
  }
  openBeside();
}

void Output::openBeside() {
  const fs::path place = scene::resolvedTarget(m_target);
  if (::access(place.c_str(), F_OK) == 0 && ::access(place.c_str(), W_OK) != 0) fail("replaced");
  m_descriptor = openNameless(place);
  m_isNameless = m_descriptor >= 0;
  if (!m_isNameless) openNamed(place);
  if (::fchmod(m_descriptor, modeOfTarget(place)) != 0) fail("given its permissions");
}

void Output::openNamed(const fs::path& place) {
  std::string name = besideOf(place).string() + ".XXXXXX";
  m_descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (m_descriptor < 0) fail("created");
  m_temporary = std::move(name);
  removeOnSignal(m_temporary);
}

/// A link cannot replace a file, and a rename can: the complete file gets a name beside its place first.
void Output::giveName() {
  const std::string source = descriptorPath(m_descriptor);
  const std::string base = besideOf(scene::resolvedTarget(m_target)).string() + '.' + std::to_string(::getpid());
  for (int attempt = 0; m_temporary.empty(); ++attempt) {
    std::string name = base + '-' + std::to_string(attempt);
    if (::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      m_temporary = std::move(name);  // without memory, of which there may be none: the file would stay
    } else if (errno != EEXIST) {
      fail("put in its place");
    }
  }
  removeOnSignal(m_temporary);
  m_isNameless = false;
}

Output::~Output() {
  if (m_descriptor >= 0 && m_descriptor != STDOUT_FILENO) ::close(m_descriptor);
  if (m_temporary.empty()) return;
  ::unlink(m_temporary.c_str());
  keepOnSignal(m_temporary);
}

bool Output::isTerminal() const { return ::isatty(m_descriptor) == 1; }

void Output::requireRoom(std::uint64_t bytes) const {
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  struct stat status {};
  struct statvfs disk {};
  if (::fstat(m_descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;  // a pipe or a device takes any
  if (::fstatvfs(m_descriptor, &disk) != 0 || disk.f_blocks == 0) return;       // some do not say how large they are
  if (disk.f_frsize == 0 || disk.f_bavail > kMost / disk.f_frsize) return;
  const std::uint64_t room = std::uint64_t{disk.f_bavail} * disk.f_frsize;
  if (bytes > room)
    throw FileError(name(), "its disk has " + mebibytes(room) + " left, and the result needs " + mebibytes(bytes));
}

void Output::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(m_descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Output::sync() const {
  struct stat status {};
  if (::fstat(m_descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (::fsync(m_descriptor) != 0) fail("written");
}

void Output::complete() {
  if (m_target.empty() || m_descriptor < 0) return;
  if (m_isNameless) giveName();
  if (::close(std::exchange(m_descriptor, -1)) != 0) fail("written");
  if (!m_temporary.empty()) m_place = scene::resolvedTarget(m_target).string();
}

void Output::commit() {
  complete();
  if (m_temporary.empty()) return;
  if (::rename(m_temporary.c_str(), m_place.c_str()) != 0) fail("put in its place");
  keepOnSignal(m_temporary);
  m_temporary.clear();
}

fs::path Output::name() const { return m_target.empty() ? "standard output" : m_target; }

void Output::fail(const char* action) const {
  const int problem = errno;
  if (problem == EPIPE) throw ClosedPipe();
  throw FileError::ofSystem(name(), std::string("cannot be ") + action, {problem, std::generic_category()});
}

}  // namespace allpairs::app
