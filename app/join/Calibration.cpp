// SPDX-License-Identifier: MIT
#include "join/Calibration.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <system_error>

#include "allpairs/generate/BoxScenes.h"
#include "allpairs/scene/FileError.h"
#include "cli/NpyOutput.h"
#include "cli/Output.h"
#include "cli/SignalCleanup.h"
#include "cli/Timer.h"

namespace allpairs::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kFewBoxes = 10'000;      // some milliseconds of work
constexpr std::uint64_t kManyBoxes = 2'000'000;  // more than caches hold, and a second of work
constexpr std::uint64_t kMostBoxes = 8'000'000;  // some seconds of work
constexpr std::uint64_t kBytesPerBox = 128;      // of the memory: making them takes 48

/// Boxes and pairs cost a quarter more each among 100 million than among 2: the nearer their numbers, the nearer the
/// time. It takes a tenth of what a long join takes, of a short one twice as long, and of the memory less than a half.
std::size_t boxesFor(const join::JoinSummary& plan, std::uint64_t memory) {
  const std::uint64_t most = memory == 0 ? kMostBoxes : std::min(memory / kBytesPerBox, kMostBoxes);
  const std::uint64_t least = std::clamp(plan.boxes, kFewBoxes, kManyBoxes);
  return static_cast<std::size_t>(std::min(std::max(plan.boxes / 16, least), most));
}

/// Where to measure: the folder that a join would work in, or the one that it would make it in.
fs::path placeFor(const fs::path& work) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(work, ignored))) return work;
  const fs::path above = (work.has_filename() ? work : work.parent_path()).parent_path();
  return above.empty() ? "." : above;
}

/// A folder that is gone in the end.
class Folder {
 public:
  explicit Folder(const fs::path& work) {
    const fs::path place = placeFor(work);
    m_path = (place / "allpairs-plan-XXXXXX").string();
    if (::mkdtemp(m_path.data()) != nullptr) return;
    const std::error_code problem(errno, std::generic_category());
    throw FileError::ofSystem(work, place == work ? "no folder can be made in it" : "cannot be made", problem);
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

void writeBoxes(const fs::path& path, std::size_t count) {
  Output output(path);
  NpyOutput(output, "<f4", {count, 6}).add(generate::makeBoxes({.count = count}));
  output.commit();
}

JoinCost costOf(const Folder& folder, std::size_t boxes, const join::JoinOptions& options) {
  const std::array<fs::path, 1> input{folder.file("boxes.npy")};
  writeBoxes(input[0], boxes);
  const Timer timer;
  (void)join::countFiles(input, options);
  const double counting = timer.seconds();
  const join::JoinSummary done = join::joinFiles(input, folder.file("pairs.npy"), options);
  const double joining = timer.seconds() - counting;
  return {counting / static_cast<double>(done.boxes + done.copies),
          std::max(0.0, joining - counting) / static_cast<double>(std::max<std::uint64_t>(done.pairs, 1))};
}

}  // namespace

double JoinCost::secondsFor(const join::JoinSummary& plan) const {
  return perRecord * static_cast<double>(plan.boxes + plan.copies) + perPair * static_cast<double>(plan.pairs);
}

/// Counting has no pairs to write, so that the difference is theirs.
JoinCost measureJoinCost(const fs::path& work, const join::JoinSummary& plan, join::JoinOptions options) {
  const StopOnSignal signals;  // before the folder, which is gone when the program ends
  options.stop = signals.flag();
  const Folder folder(work);
  options.work = folder.file("work");
  options.second.clear();
  options.distance = 0.0;  // one of the user's units may be more than the whole scene
  options.region.reset();
  options.values = {};
  options.secondValues = {};
  try {
    return costOf(folder, boxesFor(plan, options.memory), options);
  } catch (const FileError& problem) {  // of a file that is gone by now
    throw FileError(work, "the time of a join cannot be measured there: " + problem.problem(), problem.code());
  }
}

}  // namespace allpairs::app
