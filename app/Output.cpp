// SPDX-License-Identifier: MIT
#include "Output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "ExitStatus.h"
#include "allpairs/Error.h"

namespace allpairs::app {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kNewFileMode = 0666;  // as any program creates files; the umask takes away what it must

/// The file that a path means in the end, so that a link stays a link and its target is replaced.
fs::path resolved(const fs::path& path) {
  std::error_code ignored;
  fs::path target = fs::weakly_canonical(path, ignored);
  return target.empty() ? path : target;
}

mode_t modeFor(const fs::path& target) {
  struct stat existing {};
  if (::stat(target.c_str(), &existing) == 0) return existing.st_mode & 07777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return kNewFileMode & ~mask;
}

}  // namespace

Output::Output(const std::optional<fs::path>& path) {
  if (!path) {
    m_descriptor = STDOUT_FILENO;
    return;
  }
  m_target = *path;
  std::error_code ignored;
  const fs::file_status status = fs::status(m_target, ignored);
  if (fs::is_directory(status)) throw FileError(m_target, "is a folder; a file is needed to write to");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    m_descriptor = ::open(m_target.c_str(), O_WRONLY | O_CLOEXEC);
    if (m_descriptor < 0) fail("opened for writing");
    return;
  }
  openBeside();
}

void Output::openBeside() {
  const fs::path place = resolved(m_target);
  std::string name = place.string() + ".XXXXXX";
  m_descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (m_descriptor < 0) fail("created");
  m_temporary = name;
  if (::fchmod(m_descriptor, modeFor(place)) != 0) fail("given its permissions");
}

Output::~Output() {
  if (m_descriptor >= 0 && m_descriptor != STDOUT_FILENO) ::close(m_descriptor);
  if (!m_temporary.empty()) ::unlink(m_temporary.c_str());
}

bool Output::isTerminal() const { return ::isatty(m_descriptor) == 1; }

void Output::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(m_descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Output::commit() {
  if (m_target.empty()) return;
  if (::close(std::exchange(m_descriptor, -1)) != 0) fail("written");
  if (m_temporary.empty()) return;
  if (::rename(m_temporary.c_str(), resolved(m_target).c_str()) != 0) fail("put in its place");
  m_temporary.clear();
}

void Output::fail(const char* action) const {
  const int problem = errno;
  if (problem == EPIPE) throw ClosedPipe();
  const std::string name = m_target.empty() ? "standard output" : m_target.string();
  throw FileError(name, std::string("cannot be ") + action + ": " + std::generic_category().message(problem));
}

}  // namespace allpairs::app
