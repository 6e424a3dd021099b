// SPDX-License-Identifier: MIT
#include "allpairs/join/Join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <system_error>
#include <vector>

#include "DiskJoin.h"
#include "WorkFile.h"
#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadOptions.h"

namespace allpairs::join {
namespace {

namespace fs = std::filesystem;

Budget budgetOf(const JoinOptions& options, const BoxInput& input) {
  const std::uint64_t memory = options.memory != 0 ? options.memory : std::max(scene::halfOfMemory(), kLeastMemory);
  if (memory < kLeastMemory) {
    throw InvalidArgument("a join needs at least " + std::to_string(kLeastMemory >> 20) + " MiB of memory");
  }
  const std::size_t threads = options.executor != nullptr ? options.executor->concurrency() : 1;
  const std::uint64_t workers = std::min<std::uint64_t>(threads, 1 + (memory - kLeastMemory) / kMemoryPerThread);
  const std::size_t recordSize = RecordType{input.isFloat64()}.size();
  return Budget::of(memory, static_cast<std::size_t>(workers), recordSize, pairSizeFor(input.size()));
}

void checkOptions(std::span<const fs::path> inputs, const JoinOptions& options) {
  if (inputs.empty()) throw InvalidArgument("a join of no files");
  if (std::isnan(options.distance) || options.distance == -std::numeric_limits<double>::infinity()) {
    throw InvalidArgument("the distance is not a number that can be added");
  }
}

JoinSummary run(std::span<const fs::path> inputs, const ResultSink* sink, const JoinOptions& options) {
  checkOptions(inputs, options);
  if (options.work.empty()) throw InvalidArgument("a join needs a folder to work in");
  BoxInput input(inputs);
  const Budget budget = budgetOf(options, input);
  return DiskJoin(input, statesOf(inputs), options, budget, sink == nullptr).run(sink);
}

}  // namespace

JoinSummary joinFiles(std::span<const fs::path> inputs, ResultSink sink, const JoinOptions& options) {
  return run(inputs, &sink, options);
}

JoinSummary joinFiles(std::span<const fs::path> inputs, const fs::path& output, const JoinOptions& given) {
  JoinOptions options = given;
  if (options.work.empty()) options.work = output.string() + ".work";
  const fs::path part = output.string() + ".part";
  JoinSummary summary;
  try {
    WorkFile file(part, WorkFile::Mode::Create);
    std::uint64_t position = 0;
    summary = joinFiles(inputs, ResultSink([&](std::string_view bytes) {
                          file.write(position, bytes.data(), bytes.size());
                          position += bytes.size();
                        }),
                        options);
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
  std::error_code problem;
  fs::rename(part, output, problem);
  if (problem) throw FileError(output, "cannot be replaced: " + problem.message());
  return summary;
}

JoinSummary countFiles(std::span<const fs::path> inputs, const JoinOptions& options) {
  return run(inputs, nullptr, options);
}

JoinSummary planFiles(std::span<const fs::path> inputs, const JoinOptions& options) {
  checkOptions(inputs, options);
  BoxInput input(inputs);
  const Budget budget = budgetOf(options, input);
  const Division division = Divider(input, options, budget).divide();
  const std::uint64_t records = std::accumulate(division.counts.begin(), division.counts.end(), std::uint64_t{0});
  return {.boxes = input.size(),
          .pairs = division.pairs,
          .cells = division.cells.size(),
          .copies = division.copies(input.size()),
          .wideBoxes = division.counts.back(),
          .boxBytes = records * RecordType{input.isFloat64()}.size(),
          .pairBytes = division.pairs * pairSizeFor(input.size())};
}

}  // namespace allpairs::join
