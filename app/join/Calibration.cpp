// SPDX-License-Identifier: MIT
#include "join/Calibration.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <system_error>

#include "allpairs/generate/BoxScenes.h"
#include "allpairs/scene/FileError.h"
#include "cli/NpyOutput.h"
#include "cli/Output.h"
#include "cli/Timer.h"

namespace allpairs::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBoxes = 2'000'000;  // more than caches hold, and a second of work

/// A folder that is gone in the end.
class Folder {
 public:
  explicit Folder(const fs::path& place) : m_path((place / "allpairs-plan-XXXXXX").string()) {
    if (::mkdtemp(m_path.data()) == nullptr) {
      throw FileError(place, "no folder can be made in it: " + std::generic_category().message(errno));
    }
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(m_path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] fs::path file(const char* name) const { return fs::path(m_path) / name; }

 private:
  std::string m_path;
};

void writeBoxes(const fs::path& path) {
  Output output(path);
  NpyOutput(output, "<f4", {kBoxes, 6}).add(generate::makeBoxes({.count = kBoxes}));
  output.commit();
}

}  // namespace

double JoinCost::secondsFor(const join::JoinSummary& plan) const {
  return perRecord * static_cast<double>(plan.boxes + plan.copies) + perPair * static_cast<double>(plan.pairs);
}

/// Counting has no pairs to write, so that the difference is theirs.
JoinCost measureJoinCost(const fs::path& place, join::JoinOptions options) {
  const Folder folder(place);
  const std::array<fs::path, 1> input{folder.file("boxes.npy")};
  writeBoxes(input[0]);
  options.work = folder.file("work");
  options.second.clear();
  options.region.reset();
  options.values = {};
  options.secondValues = {};
  const Timer timer;
  (void)join::countFiles(input, options);
  const double counting = timer.seconds();
  const join::JoinSummary done = join::joinFiles(input, folder.file("pairs.npy"), options);
  const double joining = timer.seconds() - counting;
  return {counting / static_cast<double>(done.boxes + done.copies),
          std::max(0.0, joining - counting) / static_cast<double>(done.pairs)};
}

}  // namespace allpairs::app
