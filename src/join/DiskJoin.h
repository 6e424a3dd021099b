// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "BoxInput.h"
#include "BoxSpill.h"
#include "Budget.h"
#include "Divider.h"
#include "Manifest.h"
#include "PairRuns.h"
#include "allpairs/join/Join.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::join {

/// A join on disk, step by step.
class DiskJoin {
 public:
  DiskJoin(BoxInput& input, const JoinOptions& options, const Budget& budget, bool isCount);

  /// Writes the result to the sink, which a count has none of.
  JoinSummary run(const ResultSink* sink);

 private:
  void openFolder();
  [[nodiscard]] bool tryToOpenFolder();
  void readManifest();
  void clearFolder();
  void removeParts();
  void requireRoom(const Division& division) const;
  void distribute();
  void requireUnchanged() const;
  void dropDamaged();
  [[nodiscard]] bool hasAllBoxes();
  void dropDamagedCells();
  template <class Id>
  void searchCells();
  template <class Id>
  void searchCell(std::size_t cell, class CellJoin& join, RunWriter<Id>* writer);
  void keep(std::size_t cell, CellResult result);
  template <class Id>
  void writePairs(ResultSink sink);
  template <class Id>
  void finish(const ResultSink* sink);
  [[nodiscard]] JoinSummary summary() const;
  [[nodiscard]] const RecordType& recordType() const { return m_input.recordType(); }
  [[nodiscard]] std::size_t pairSize() const { return pairSizeFor(m_input.largestSize()); }
  [[nodiscard]] std::size_t tasks() const { return m_cells.size() + 1; }  ///< Of searching: cells, and the wide boxes.
  [[nodiscard]] std::filesystem::path file(const char* name) const { return m_options.work / name; }
  void report(std::string_view step, std::uint64_t done, std::uint64_t total);

  BoxInput& m_input;
  const JoinOptions& m_options;
  const Budget& m_budget;
  KeyRanges m_ranges;
  Manifest m_manifest;
  partition::Partition m_cells;
  std::optional<BoxSpill> m_spill;
  RunFile m_runs;
  WorkFile m_lock;
  std::mutex m_mutex;  ///< Of the manifest and of progress.
  double m_lastSaved = 0.0;
  std::uint64_t m_resumed = 0;
};

}  // namespace allpairs::join
