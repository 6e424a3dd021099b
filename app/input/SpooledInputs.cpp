// SPDX-License-Identifier: MIT
#include "input/SpooledInputs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <system_error>

#include "allpairs/scene/FileError.h"
#include "cli/ExitStatus.h"
#include "cli/SignalCleanup.h"
#include "cli/TemporaryFolder.h"

namespace allpairs::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "standard input";

std::string lastProblem() { return std::generic_category().message(errno); }

bool isStandardInput(const std::string& path) {
  return path == "-" || path == "/dev/stdin" || path == "/dev/fd/0" || path == "/proc/self/fd/0";
}

/// Of a shell's <(...), which has another number each time.
bool isDescriptor(const fs::path& path) {
  return path.parent_path() == "/dev/fd" || path.parent_path() == "/proc/self/fd";
}

bool isReadOnce(const std::string& path) {
  std::error_code ignored;
  return isStandardInput(path) || fs::is_fifo(path, ignored);
}

/// A descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : m_number(number) {}
  ~Descriptor() {
    if (m_number > STDERR_FILENO) ::close(m_number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  [[nodiscard]] int number() const { return m_number; }

 private:
  int m_number;
};

void writeAll(int target, const char* bytes, std::size_t count, const fs::path& file) {
  while (count > 0) {
    const ssize_t written = ::write(target, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw FileError(file, "cannot be written: " + lastProblem());
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

void copyAll(int source, const fs::path& shown, int target, const fs::path& file) {
  std::array<char, 65536> bytes{};  // what a pipe holds
  while (true) {
    const ssize_t count = ::read(source, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw FileError(shown, "cannot be read: " + lastProblem());
    if (count == 0) return;
    writeAll(target, bytes.data(), static_cast<std::size_t>(count), file);
  }
}

}  // namespace

SpooledInputs::SpooledInputs(std::vector<std::string>& paths, const std::string& format) {
  if (std::count_if(paths.begin(), paths.end(), isStandardInput) > 1)
    throw UsageError("standard input can be read only once");
  if (!format.empty() && std::none_of(paths.begin(), paths.end(), isReadOnce))
    throw UsageError("--input-format is for standard input and pipes; a file's name says what it is");
  try {
    for (std::string& path : paths) {
      if (isReadOnce(path)) spool(path, format);
    }
  } catch (...) {
    removeAll();
    throw;
  }
}

SpooledInputs::~SpooledInputs() { removeAll(); }

fs::path SpooledInputs::shown(const fs::path& file) const {
  const auto known = std::find_if(m_files.begin(), m_files.end(), [&](const Spooled& one) { return one.file == file; });
  return known == m_files.end() ? file : known->shown;
}

std::string SpooledInputs::shownIn(std::string text) const {
  for (const Spooled& one : m_files) {
    const std::string file = one.file.string();
    const std::string shown = one.shown.string();
    for (std::size_t at = text.find(file); at != std::string::npos; at = text.find(file, at + shown.size()))
      text.replace(at, file.size(), shown);
  }
  return text;
}

bool SpooledInputs::isSource(const fs::path& file) const {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return false;
  const std::pair identity(status.st_dev, status.st_ino);
  return std::any_of(m_files.begin(), m_files.end(), [&](const Spooled& one) { return one.source == identity; });
}

void SpooledInputs::spool(std::string& path, const std::string& format) {
  const bool isStandard = isStandardInput(path);
  const std::string extension = format.empty() ? fs::path(path).extension().string() : '.' + format;
  const std::string number = m_files.empty() ? "" : ' ' + std::to_string(m_files.size() + 1);
  const std::string pipe = isDescriptor(path) ? "pipe" + number : path;
  const std::string shown = isStandard ? kStandardInput : pipe;
  if (extension.empty()) throw UsageError(shown + ": --input-format must say what it is: npy, csv, obj, stl, scn, ...");
  if (m_folder.empty()) makeFolder();
  const std::string stem = isStandard ? "stdin" : fs::path(pipe).stem().string();
  const fs::path folder = m_folder / std::to_string(m_files.size());  // so that pipes of any names have their own
  const fs::path file = folder / (stem + extension);
  m_files.push_back({folder, file, shown, std::nullopt});
  removeOnSignal(folder);
  removeOnSignal(file);
  if (::mkdir(folder.c_str(), 0700) != 0) throw FileError(folder, "cannot be created: " + lastProblem());
  const Descriptor source(isStandard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (source.number() < 0) throw FileError(path, "cannot be opened: " + lastProblem());
  struct stat status {};
  if (::fstat(source.number(), &status) == 0 && S_ISREG(status.st_mode))
    m_files.back().source = std::pair(status.st_dev, status.st_ino);
  const Descriptor target(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (target.number() < 0) throw FileError(file, "cannot be created: " + lastProblem());
  copyAll(source.number(), shown, target.number(), file);
  path = file.string();
}

void SpooledInputs::makeFolder() {
  std::string name = temporaryFolder() / "allpairs-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw FileError(name, "cannot be created: " + lastProblem());
  m_folder = name;
  removeOnSignal(m_folder);
}

void SpooledInputs::removeAll() noexcept {
  std::error_code ignored;
  if (m_folder.empty()) return;
  fs::remove_all(m_folder, ignored);
  for (const Spooled& one : m_files) {
    keepOnSignal(one.folder.native());
    keepOnSignal(one.file.native());
  }
  keepOnSignal(m_folder.native());
}

void withSpooledInputs(std::vector<std::string>& paths, const std::string& format,
                       const std::function<void(const SpooledInputs&)>& work) {
  const SpooledInputs spooled(paths, format);
  try {
    work(spooled);
  } catch (const FileError& problem) {
    const fs::path shown = spooled.shown(problem.path());
    const std::string text = spooled.shownIn(problem.problem());
    if (shown == problem.path() && text == problem.problem()) throw;
    throw FileError(shown, text, problem.line(), problem.column());
  } catch (const UsageError& problem) {
    throw UsageError(spooled.shownIn(problem.what()));
  }
}

}  // namespace allpairs::app
