// SPDX-License-Identifier: MIT
#include "allpairs/join/Join.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>

#include "Checksum.h"
#include "DiskJoin.h"
#include "WorkFile.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadOptions.h"
#include "allpairs/scene/TargetFile.h"

namespace allpairs::join {
namespace {

namespace fs = std::filesystem;

Budget budgetOf(const JoinOptions& options, const BoxInput& input) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 50;
  const std::uint64_t given = options.memory != 0 ? options.memory : std::max(scene::halfOfMemory(), kLeastMemory);
  const std::uint64_t memory = std::min(given, kMost);
  if (memory < kLeastMemory) {
    throw InvalidArgument("a join needs at least " + std::to_string(kLeastMemory >> 20) + " MiB of memory");
  }
  const std::size_t threads =
      options.executor != nullptr ? std::max<std::size_t>(options.executor->concurrency(), 1) : 1;
  const std::uint64_t workers = std::min<std::uint64_t>(threads, 1 + (memory - kLeastMemory) / kMemoryPerThread);
  return Budget::of(memory, static_cast<std::size_t>(workers), input.recordType(), pairSizeFor(input.largestSize()));
}

/// A file that is written beside its place and renamed. It is made when there is something to write, and removed if it
/// is not complete. Its name is that of its place and a number of the work folder: no other join has it meanwhile, and
/// one that goes on after a kill removes what this left.
class PartFile {
 public:
  /// Bad input: a place that is taken by what is no file, such as a device, or where nothing can be written, throws
  ///            FileError.
  PartFile(const fs::path& target, const fs::path& work) : m_given(target), m_target(scene::resolvedTarget(target)) {
    constexpr std::size_t kMostOfName = 200;  // of 255
    const fs::path folder = m_target.has_parent_path() ? m_target.parent_path() : fs::path(".");
    if (::access((folder / "").c_str(), W_OK | X_OK) != 0) fail("written", {errno, std::generic_category()});
    m_part = folder / (m_target.filename().string().substr(0, kMostOfName) + '.' + numberOf(work) + ".part");
    std::error_code problem;
    const fs::file_status there = fs::status(m_target, problem);
    if (there.type() == fs::file_type::none) fail("written", problem);
    if (!fs::exists(there)) return;
    if (!fs::is_regular_file(there)) throw FileError(target, "is there and is no file that can be replaced");
    m_mode = there.permissions();
  }
  ~PartFile() {
    std::error_code ignored;
    if (m_isThere) fs::remove(m_part, ignored);
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  void write(std::string_view bytes) {
    underTarget([&] {
      if (!m_isThere) m_file = WorkFile(m_part, WorkFile::Mode::Create);
      m_isThere = true;
      m_file.write(m_position, bytes.data(), bytes.size());
    });
    m_position += bytes.size();
  }

  /// On disk before it has its name, since what it was made from is removed then.
  void commit() {
    underTarget([this] { m_file.sync(); });
    std::error_code problem;
    if (m_mode && !m_file.setPermissions(*m_mode)) problem.assign(errno, std::generic_category());
    if (!problem) fs::rename(m_part, m_target, problem);
    if (problem) fail("replaced", problem);
    m_isThere = false;
    scene::syncNameOf(m_target);
  }

 private:
  /// The same of a folder that is there and of one that is not yet, with a slash behind it or not.
  static std::string numberOf(const fs::path& folder) {
    const fs::path named = folder.has_filename() ? folder : folder.parent_path();
    return std::to_string(checksumOf(scene::resolvedTarget(fs::absolute(named)).string()) >> 32U);
  }

  /// Says what fails of the file that the caller has named.
  template <class Use>
  void underTarget(const Use& use) const {
    try {
      use();
    } catch (const FileError& problem) {
      throw FileError(m_given, problem.problem(), problem.code());
    }
  }

  [[noreturn]] void fail(const char* action, std::error_code problem) const {
    throw FileError::ofSystem(m_given, std::string("cannot be ") + action, problem);
  }

  fs::path m_given;
  fs::path m_target;
  fs::path m_part;
  std::optional<fs::perms> m_mode;  ///< Of the file that is replaced.
  WorkFile m_file;
  bool m_isThere = false;
  std::uint64_t m_position = 0;
};

bool hasAny(const scene::BoxValueFiles& files) {
  return !files.margins.empty() || !files.groups.empty() || !files.categories.empty() || !files.masks.empty();
}

void checkOptions(std::span<const fs::path> inputs, const JoinOptions& options) {
  if (inputs.empty()) throw InvalidArgument("a join of no files");
  if (!isDistance(options.distance)) throw InvalidArgument("the distance is NaN or -infinity");
  if (options.region) (void)countOverlaps(BoxView(), {.region = options.region});  // refuses one that makes no sense
  if (options.second.empty() && hasAny(options.secondValues)) {
    throw InvalidArgument("margins, groups, categories or masks of a second set, and one set");
  }
}

/// The path without links, of what is there or not.
fs::path canonicalOf(const fs::path& path) {
  const fs::path target = fs::absolute(scene::resolvedTarget(path));
  std::error_code problem;
  const fs::path canonical = fs::weakly_canonical(target.has_filename() ? target : target.parent_path(), problem);
  return problem ? target.lexically_normal() : canonical;
}

/// The work folder goes when the result has its name, and what has the name of one of its files with it.
void checkIsNotIn(const fs::path& work, const fs::path& output) {
  const fs::path folder = canonicalOf(work);
  const fs::path result = canonicalOf(output);
  if (std::mismatch(folder.begin(), folder.end(), result.begin(), result.end()).first != folder.end()) return;
  throw FileError(output, "is the folder of the join's own files, which is removed in the end, or lies in it");
}

/// What a box is where it travels: categories and masks share a word.
std::uint64_t sentSizeOf(const RecordType& type) {
  const bool hasBits = type.hasCategories || type.hasMasks;
  return sizeof(std::uint64_t) * (1 + (type.hasMargins ? 1U : 0U) + (hasBits ? 1U : 0U) + (type.hasGroups ? 1U : 0U)) +
         type.boundsSize();
}

JoinSummary run(std::span<const fs::path> inputs, const ResultSink* sink, const JoinOptions& options) {
  checkOptions(inputs, options);
  if (options.work.empty()) throw InvalidArgument("a join needs a folder to work in");
  if (!options.output.empty()) checkIsNotIn(options.work, options.output);
  BoxInput input(inputs, options);
  const Budget budget = budgetOf(options, input);
  return DiskJoin(input, options, budget, sink == nullptr).run(sink);
}

}  // namespace

JoinSummary joinFiles(Span<const fs::path> inputs, ResultSink sink, const JoinOptions& options) {
  return run(inputs, &sink, options);
}

JoinSummary joinFiles(Span<const fs::path> inputs, const fs::path& output, const JoinOptions& given) {
  std::error_code ignored;
  if (output.filename().empty() || fs::is_directory(output, ignored)) throw FileError(output, "is no name for a file");
  JoinOptions options = given;
  if (options.work.empty()) options.work = output.string() + ".work";
  scene::checkIsNoInput(output, inputs);
  scene::checkIsNoInput(output, options.second);
  for (const scene::BoxValueFiles& files : {options.values, options.secondValues}) {
    for (const auto& of : {files.margins, files.groups, files.categories, files.masks})
      scene::checkIsNoInput(output, of);
  }
  options.output = output;
  PartFile part(output, options.work);
  options.commit = [&part] { part.commit(); };
  return joinFiles(inputs, ResultSink([&part](std::string_view bytes) { part.write(bytes); }), options);
}

JoinSummary countFiles(Span<const fs::path> inputs, const JoinOptions& options) {
  return run(inputs, nullptr, options);
}

JoinSummary planFiles(Span<const fs::path> inputs, const JoinOptions& options) {
  checkOptions(inputs, options);
  BoxInput input(inputs, options);
  const Budget budget = budgetOf(options, input);
  const Division division = Divider(input, options, budget).divide();
  const std::size_t pairSize = pairSizeFor(input.largestSize());
  return {.boxes = input.size(),
          .pairs = division.pairs,
          .cells = division.cells.size(),
          .copies = division.copies(),
          .wideBoxes = division.wideBoxes(),
          .boxBytes = division.records() * input.recordType().size(),
          .pairBytes = division.pairBytes(pairSize),
          .secondBoxes = input.size(1),
          .empty = division.empty,
          .scratchBytes = division.scratchBytes(pairSize, budget.mergeBytes)};
}

RanksPlan planRanks(Span<const fs::path> inputs, std::size_t ranks, const JoinOptions& options) {
  checkOptions(inputs, options);
  if (ranks == 0) throw InvalidArgument("a search on no ranks");
  BoxInput input(inputs, options);
  Budget budget = budgetOf(options, input);
  const std::size_t cells = ranks == 1 ? 1 : partition::cellsOnRanks(input.size(), ranks);
  budget.workers = 1;
  budget.leastCells = cells;
  budget.fairBoxes = static_cast<std::size_t>(std::max<std::uint64_t>(input.size() / cells, 1));
  budget.cellBoxes = 2 * budget.fairBoxes;  // as mpi::Distribution
  const Division division = Divider(input, options, budget).divide();
  const std::uint64_t recordSize = sentSizeOf(input.recordType());
  const std::uint64_t most = partition::mostInCellOnRanks(input.size(), ranks);
  std::uint64_t wide = division.wideBoxes();
  for (std::size_t cell = 0; cell < division.cells.size(); ++cell) {
    if (division.countOf(cell) > most) wide += division.countOf(cell);
  }
  const auto leaving = [ranks](std::uint64_t bytes) { return bytes / ranks * (ranks - 1); };  // for another rank
  return {.boxes = input.size(),
          .pairs = division.pairs,
          .cells = division.cells.size(),
          .copies = division.copies(),
          .wideBoxes = wide,
          .boxBytes = leaving((division.records() - wide) * recordSize) + (ranks - 1) * wide * recordSize,
          .pairBytes = leaving(division.pairBytes(pairSizeFor(input.largestSize()))),
          .secondBoxes = input.size(1),
          .empty = division.empty};
}

}  // namespace allpairs::join
