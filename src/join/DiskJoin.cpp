// SPDX-License-Identifier: MIT
#include "DiskJoin.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "CellJoin.h"
#include "FreedMemory.h"
#include "PairMerge.h"
#include "allpairs/StopFlag.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/FolderNames.h"
#include "allpairs/scene/TargetFile.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::join {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = "allpairs-join.lock";
constexpr double kSaveInterval = 0.5;  // seconds of searching that a kill may cost

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

template <class Id>
std::string headerFor(std::uint64_t pairs) {
  const std::string order = std::endian::native == std::endian::little ? "<" : ">";
  return scene::npyHeader(order + (sizeof(Id) == 4 ? "u4" : "u8"), std::array<std::uint64_t, 2>{pairs, 2});
}

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; }

/// The folder that a file takes room in; none of what is no file, such as a device.
std::optional<fs::path> folderOf(const fs::path& file) {
  std::error_code ignored;
  if (file.empty() || (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))) return std::nullopt;
  return fs::absolute(scene::resolvedTarget(file)).parent_path();
}

bool isOnDiskOf(const fs::path& a, const fs::path& b) {
  struct stat one {};
  struct stat other {};
  return ::stat(a.c_str(), &one) == 0 && ::stat(b.c_str(), &other) == 0 && one.st_dev == other.st_dev;
}

void requireRoomIn(const fs::path& folder, std::uint64_t bytes, const std::string& problem) {
  std::error_code unknown;
  const fs::space_info space = fs::space(folder, unknown);
  if (unknown || space.capacity == 0 || bytes <= space.available) return;  // some do not say how large they are
  throw FileError(folder, "its disk has " + megabytes(space.available) + problem,
                  std::make_error_code(std::errc::no_space_on_device));
}

/// Whether a folder has that name, which may be a link to nothing.
bool isListed(const fs::path& folder, const fs::path& name) {
  std::error_code unknown;
  const fs::file_status found = fs::symlink_status(folder / name, unknown);
  if (!fs::status_known(found)) throw FileError::ofSystem(folder, "cannot be read", unknown);
  return fs::exists(found);
}

/// The scratch files of ranges that were divided, and divided again: a join that was killed leaves some of them.
constexpr std::string_view kDivided = "divided";

bool isOfDivided(std::string_view name) {
  return name.substr(0, kDivided.size()) == kDivided && name.find_first_not_of('-', kDivided.size()) == name.npos;
}

}  // namespace

DiskJoin::DiskJoin(BoxInput& input, const JoinOptions& options, const Budget& budget, bool isCount)
    : m_input(input),
      m_options(options),
      m_budget(budget),
      m_ranges(KeyRanges::of(0, input.size(0), false, kMostRanges)) {
  m_manifest.inputs = statesOf(input.paths());
  m_manifest.secondFiles = input.secondFiles();
  m_manifest.values = statesOf(input.valuePaths());
  m_manifest.distance = options.distance;
  m_manifest.region = options.region;
  m_manifest.isCount = isCount;
}

JoinSummary DiskJoin::run(const ResultSink* sink) {
  openFolder();
  try {
    readManifest();
    if (m_manifest.extents.empty()) distribute();
    if (pairSize() == sizeof(StoredPair<std::uint32_t>)) {
      finish<std::uint32_t>(sink);
    } else {
      finish<std::uint64_t>(sink);
    }
    if (sink != nullptr && m_options.commit) m_options.commit();
  } catch (...) {
    if (isAbsent(file("manifest"))) clearFolder();  // there is nothing to go on with
    throw;
  }
  clearFolder();
  return summary();
}

/// The manifest goes first: what is left without one is nothing to go on with.
void DiskJoin::clearFolder() {
  std::error_code ignored;
  for (const char* name : {"manifest", "manifest.next"}) fs::remove(file(name), ignored);
  removeParts();
  fs::remove(file(kLock), ignored);
  ::rmdir(m_options.work.c_str());  // if it is empty and no link: it may be the user's
}

/// Boxes, pairs, and what is left of putting pairs in order.
void DiskJoin::removeParts() {
  m_spill.reset();
  m_runs.file = {};
  std::error_code ignored;
  for (const char* name : {"boxes", "pairs"}) fs::remove(file(name), ignored);
  for (const std::string& name : scene::folderNames(m_options.work, ignored)) {
    if (isOfDivided(name)) fs::remove(file(name.c_str()), ignored);
  }
}

/// Takes a folder that is empty, or that a join left. A join that ends removes its folder, the lock last: at any time
/// another may find one half, or lock a file that is no longer there, and looks again.
void DiskJoin::openFolder() {
  constexpr int kMostLooks = 100;  // each is another join that ended meanwhile
  for (int look = 0; look < kMostLooks; ++look) {
    if (tryToOpenFolder()) return;
  }
  throw FileError(m_options.work, "is in use by other joins, one after the other");
}

/// Returns whether the folder is locked; it is not where a join ended meanwhile.
bool DiskJoin::tryToOpenFolder() {
  std::error_code problem;
  fs::create_directory(m_options.work, problem);  // none above it: a folder of that name is likely mistyped
  if (problem == std::errc::file_exists) {
    std::error_code ignored;
    const fs::file_type now = fs::symlink_status(m_options.work, ignored).type();
    if (now == fs::file_type::not_found || now == fs::file_type::directory) return false;  // a join ended meanwhile
    throw FileError(m_options.work, "is not a folder");
  }
  if (problem) throw FileError::ofSystem(m_options.work, "cannot be made", problem);
  const std::vector<std::string> names = scene::folderNames(m_options.work, problem);
  if (problem == std::errc::no_such_file_or_directory) return false;
  if (problem) throw FileError::ofSystem(m_options.work, "cannot be read", problem);
  const bool isOurs = std::find(names.begin(), names.end(), kLock) != names.end();
  if (!isOurs && !names.empty()) {
    const bool isOther = isListed(m_options.work, kLock) || !isListed(m_options.work, names.front());
    if (isOther) return false;  // a join that began meanwhile, or ended
    throw FileError(m_options.work, "is not empty, and not the work folder of a join");
  }
  std::optional<WorkFile> lock = WorkFile::unlessFolderIsGone(file(kLock));
  if (!lock) return false;
  m_lock = std::move(*lock);
  if (!m_lock.lock()) throw FileError(m_options.work, "is in use by another join");
  return m_lock.isThere();
}

void DiskJoin::readManifest() {
  std::optional<Manifest> found = Manifest::read(file("manifest"));
  if (!found) return;
  if (!m_options.resume) {
    throw FileError(m_options.work, "has a join that did not end: resume it, or remove the folder");
  }
  if (found->inputs != m_manifest.inputs || found->secondFiles != m_manifest.secondFiles ||
      found->values != m_manifest.values) {
    throw FileError(m_options.work, "has a join of other files, or they changed");
  }
  if (found->distance != m_manifest.distance || found->region != m_manifest.region ||
      found->isCount != m_manifest.isCount) {
    throw FileError(m_options.work, "has a join with other options");
  }
  m_manifest = std::move(*found);
  m_cells = partition::Partition::fromCuts(m_manifest.cuts);
  dropDamaged();
}

/// Forgets what is not as it was written, so that it is made again.
void DiskJoin::dropDamaged() {
  if (!hasAllBoxes()) {
    m_manifest.extents.clear();  // all boxes are distributed again
    m_manifest.cells.clear();
    m_spill.reset();
  }
  if (!m_manifest.isCount && !m_manifest.cells.empty()) dropDamagedCells();
  const auto isCell = [this](const auto& cell) { return cell.first < m_cells.size(); };  // and no task of wide boxes
  m_resumed = static_cast<std::uint64_t>(std::count_if(m_manifest.cells.begin(), m_manifest.cells.end(), isCell));
}

bool DiskJoin::hasAllBoxes() {
  if (isAbsent(file("boxes"))) return false;
  m_spill.emplace(file("boxes"), recordType(), m_manifest.extents);
  for (std::size_t cell = 0; cell < m_manifest.extents.size(); ++cell) {
    report("checking", cell, m_manifest.extents.size());
    if (!m_spill->isIntact(cell, m_options.stop)) return false;
  }
  return true;
}

/// Forgets cells of whose pairs not all are there. New runs go behind those that stay.
void DiskJoin::dropDamagedCells() {
  if (isAbsent(file("pairs"))) {
    m_manifest.cells.clear();
    return;
  }
  m_runs.file = WorkFile(file("pairs"), WorkFile::Mode::Open);
  const auto isIntact = [this](const Run& run) {
    return checksumOf(m_runs.file, run.position, bytesOf(run, m_ranges, pairSize()), m_options.stop) == run.checksum;
  };
  std::size_t checked = 0;
  const std::size_t all = m_manifest.cells.size();
  std::erase_if(m_manifest.cells, [&](const auto& cell) {
    report("checking pairs", checked++, all);
    const std::vector<Run>& runs = cell.second.runs;
    return !std::all_of(runs.begin(), runs.end(), isIntact);
  });
  for (const auto& [number, result] : m_manifest.cells) {
    for (const Run& run : result.runs) {
      m_runs.end = std::max(m_runs.end.load(), run.position + bytesOf(run, m_ranges, pairSize()));
    }
  }
}

void DiskJoin::requireRoom(const Division& division) const {
  const std::uint64_t boxes = division.records() * recordType().size();
  const std::uint64_t pairs = m_manifest.isCount ? 0 : division.pairBytes(pairSize());
  const std::uint64_t scratch = m_manifest.isCount ? 0 : division.scratchBytes(pairSize(), m_budget.mergeBytes);
  const std::string found =
      " left, and this join needs " + megabytes(boxes) + " for boxes and about " + megabytes(pairs) + " for pairs";
  const std::string order = scratch == 0 ? "" : ", and " + megabytes(scratch) + " to put them in order";
  const std::optional<fs::path> output = folderOf(m_options.output);
  if (output && isOnDiskOf(*output, m_options.work)) {
    requireRoomIn(m_options.work, boxes + 2 * pairs + scratch, found + ", as much for the result" + order);
  } else {
    requireRoomIn(m_options.work, boxes + pairs + scratch, found + order);
    if (output) requireRoomIn(*output, pairs, " left, and the result needs about " + megabytes(pairs));
  }
}

void DiskJoin::distribute() {
  const Division division = Divider(m_input, m_options, m_budget).divide();
  removeParts();  // of a join that was killed, or is damaged: their room is what this one needs
  requireRoom(division);
  m_cells = division.cells;
  m_spill.emplace(file("boxes"), recordType(), division.counts, m_budget.bufferBytes);
  m_input.forEachBlock([&](const BoxBlock& block) {
    checkStop(m_options.stop);
    visitCells(division, block, m_options, [&](std::size_t i, std::span<const std::uint32_t> cells) {
      for (const std::uint32_t cell : cells) m_spill->add(partOf(m_cells, block.set, cell), block, i);
    });
    report("distributing", block.before + block.boxes.size(), m_input.size());
  });
  m_spill->finish();
  requireUnchanged();
  m_manifest.outside = m_input.size() - division.sent[0] - division.sent[1];
  m_manifest.empty = division.empty;
  m_manifest.cuts.assign(m_cells.cuts().begin(), m_cells.cuts().end());
  m_manifest.extents = m_spill->extents();
  m_manifest.write(file("manifest"));
}

void DiskJoin::requireUnchanged() const {
  constexpr const char* kProblem = "changed while it was read";
  const std::vector<InputState> inputs = statesOf(m_input.paths());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i] != m_manifest.inputs[i]) throw FileError(m_input.paths()[i], kProblem);
  }
  const std::vector<ValueState> values = statesOf(m_input.valuePaths());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] != m_manifest.values[i]) throw FileError(m_input.valuePaths()[i].path, kProblem);
  }
}

template <class Id>
void DiskJoin::finish(const ResultSink* sink) {
  releaseFreedMemory();
  searchCells<Id>();
  releaseFreedMemory();
  if (sink != nullptr) writePairs<Id>(*sink);
}

/// Workers take the next cell until there is none; where one fails, the others end after theirs.
template <class Id>
void DiskJoin::searchCells() {
  if (!m_manifest.isCount && m_runs.end == 0) m_runs.file = WorkFile(file("pairs"), WorkFile::Mode::Create);
  std::vector<std::size_t> left;
  for (std::size_t cell = 0; cell < tasks(); ++cell) {
    if (!m_manifest.cells.contains(cell)) left.push_back(cell);
  }
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> hasFailed = false;
  const auto work = [&](std::size_t) {
    try {
      CellJoin join(*m_spill, m_cells, m_budget.cellBoxes,
                    {.order = Order::Unordered, .distance = m_options.distance, .stop = m_options.stop});
      std::optional<RunWriter<Id>> writer;
      if (!m_manifest.isCount) writer.emplace(m_ranges, m_budget.bufferPairs, m_runs, m_options.stop);
      for (std::size_t i = next++; i < left.size() && !hasFailed; i = next++) {
        searchCell(left[i], join, writer ? &*writer : nullptr);
      }
    } catch (...) {
      hasFailed = true;
      throw;
    }
  };
  SerialExecutor serial;
  Executor& executor = m_options.executor != nullptr ? *m_options.executor : serial;
  try {
    executor.run(std::min(m_budget.workers, left.size()), work);
  } catch (...) {
    try {
      m_manifest.write(file("manifest"));  // cells that are complete are not searched again
    } catch (...) {                        // as on a disk that is full: what was saved before stays
    }
    throw;
  }
  m_manifest.write(file("manifest"));
}

template <class Id>
void DiskJoin::searchCell(std::size_t cell, CellJoin& join, RunWriter<Id>* writer) {
  CellResult result;
  const bool isOneSet = m_input.sets() == 1;
  join.search(cell, [&](std::span<const Pair> pairs, const Records& first, const Records& second) {
    result.pairs += pairs.size();
    if (writer == nullptr) return;
    for (const Pair pair : pairs) {
      const std::uint64_t a = first.id(pair.first);
      const std::uint64_t b = second.id(pair.second);
      writer->add(isOneSet ? std::min(a, b) : a, isOneSet ? std::max(a, b) : b);
    }
  });
  if (writer != nullptr) result.runs = writer->finish();
  keep(cell, std::move(result));
}

void DiskJoin::keep(std::size_t cell, CellResult result) {
  const std::lock_guard lock(m_mutex);
  m_manifest.cells[cell] = std::move(result);
  if (now() - m_lastSaved > kSaveInterval) {
    m_manifest.write(file("manifest"));
    m_lastSaved = now();
  }
  report("searching", m_manifest.cells.size(), tasks());
}

template <class Id>
void DiskJoin::writePairs(ResultSink sink) {
  std::vector<Run> runs;
  std::uint64_t pairs = 0;
  for (const auto& [number, result] : m_manifest.cells) {
    pairs += result.pairs;
    runs.insert(runs.end(), result.runs.begin(), result.runs.end());
  }
  sink(headerFor<Id>(pairs));
  std::uint64_t written = 0;
  const std::uint64_t seconds = m_input.size(m_input.sets() - 1);
  PairMerge<Id> merge(m_ranges, seconds, m_budget.mergeBytes, m_runs.file, file(kDivided.data()), m_options.stop);
  merge.merge(runs, [&](std::span<const StoredPair<Id>> batch) {
    sink({reinterpret_cast<const char*>(batch.data()), batch.size_bytes()});
    written += batch.size();
    report("writing", written, pairs);
  });
}

JoinSummary DiskJoin::summary() const {
  JoinSummary summary{.boxes = m_input.size(), .cells = m_cells.size()};
  std::uint64_t records = 0;
  for (const Extent& extent : m_manifest.extents) records += extent.count;
  for (const auto& [number, result] : m_manifest.cells) summary.pairs += result.pairs;
  summary.copies = records - (summary.boxes - m_manifest.outside);
  for (std::size_t set = 0; set < m_input.sets(); ++set) {
    summary.wideBoxes += m_manifest.extents[partOf(m_cells, set, m_cells.size())].count;
  }
  summary.secondBoxes = m_input.size(1);
  summary.empty = m_manifest.empty;
  summary.boxBytes = records * recordType().size();
  summary.pairBytes = m_manifest.isCount ? 0 : summary.pairs * pairSize();
  summary.resumedCells = m_resumed;
  return summary;
}

void DiskJoin::report(std::string_view step, std::uint64_t done, std::uint64_t total) {
  if (m_options.progress) m_options.progress({step, done, total});
}

}  // namespace allpairs::join
