// SPDX-License-Identifier: MIT
#include "Program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// In the child, between fork and exec: only calls that are safe there.
void redirect(int descriptor, const char* path) {
  const int file = ::open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
  if (file != descriptor) ::close(file);
}

void redirectOutput(StandardOutput output, const char* path) {
  if (output == StandardOutput::Captured) redirect(STDOUT_FILENO, path);
  if (output == StandardOutput::FullDevice) redirect(STDOUT_FILENO, "/dev/full");
  if (output == StandardOutput::Closed) ::close(STDOUT_FILENO);
  if (output == StandardOutput::ClosedPipe) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0 || ::dup2(ends[1], STDOUT_FILENO) < 0) ::_exit(126);
    ::close(ends[0]);
  }
}

ProgramRun run(std::vector<std::string> words, StandardOutput output) {
  const TempFolder folder;
  const std::string outPath = folder.path() / "out";
  const std::string errPath = folder.path() / "err";
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    redirect(STDERR_FILENO, errPath.c_str());
    redirectOutput(output, outPath.c_str());
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }
  int status = 0;
  if (::waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait for the program");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readBytes(outPath), readBytes(errPath)};
}

}  // namespace

ProgramRun runProgram(const std::vector<std::string>& arguments, StandardOutput output) {
  std::vector<std::string> words{ALLPAIRS_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run(std::move(words), output);
}

ProgramRun runScript(const std::string& script) {
  return run({"/bin/sh", "-c", script, ALLPAIRS_PROGRAM}, StandardOutput::Captured);
}

}  // namespace allpairs::test
