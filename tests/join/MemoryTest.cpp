// SPDX-License-Identifier: MIT
// The memory that a process has at most while pairs are put in order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "PairMerge.h"
#include "support/ProcessMemory.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// The pairs of one box with so many of lower and of higher numbers, put in order in `memory` bytes; the most that a
/// process has then beyond what it had, in MiB.
double peakOfRow(std::uint32_t below, std::uint32_t above, std::size_t memory) {
  const TempFolder folder;
  const std::uint32_t boxes = below + above + 1;
  const join::KeyRanges ranges = join::KeyRanges::of(0, boxes, false, join::kMostRanges);
  join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
  std::vector<join::Run> runs;
  {
    join::RunWriter<std::uint32_t> writer(ranges, 100'000, file);
    for (std::uint32_t i = 0; i < boxes; ++i) {
      if (i != below) writer.add(std::min(i, below), std::max(i, below));
    }
    runs = writer.finish();
  }
  const double held = residentMegabytes();
  const std::optional<double> peak = peakMegabytesOf([&] {
    { const std::vector<char> before(memory / 2); }  // as a step before it has
    std::uint64_t received = 0;
    join::PairMerge<std::uint32_t> merge(ranges, boxes, memory, file.file, folder.path() / "divided");
    merge.merge(runs, [&](std::span<const join::StoredPair<std::uint32_t>> batch) { received += batch.size(); });
    if (received != boxes - 1) throw std::runtime_error("other pairs");
  });
  if (!peak) throw std::runtime_error("no pairs");
  return *peak - held;
}

/// The C library keeps what is freed, and what is allocated then lies beside it.
TEST(Memory, OfRangesThatAreDividedIsNoMoreThanWasGiven) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer has memory of its own";
  if (statusMegabytes("VmHWM:") <= 0.0) GTEST_SKIP() << "the system does not say";
  for (const double megabytes : {16.0, 28.0}) {
    const double peak = peakOfRow(2'000'000, 3'000'000, static_cast<std::size_t>(megabytes * 0x1p20));
    EXPECT_GT(peak, 0.5 * megabytes) << "it was not measured";
    EXPECT_LT(peak, megabytes);
  }
}

}  // namespace
}  // namespace allpairs::test
