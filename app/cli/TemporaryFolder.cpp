// SPDX-License-Identifier: MIT
#include "cli/TemporaryFolder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "allpairs/scene/FileError.h"

namespace allpairs::app {

std::filesystem::path temporaryFolder() {
  std::error_code problem;
  std::filesystem::path folder = std::filesystem::temp_directory_path(problem);
  if (!problem) return folder;
  const std::string text = "no folder for temporary files: " + problem.message();
  for (const char* variable : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {  // that the standard library looks at, in order
    const char* value = std::getenv(variable);
    if (value != nullptr) throw FileError(std::string(variable) + '=' + value, text);
  }
  throw FileError("/tmp", text);
}

}  // namespace allpairs::app
