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
#include "Manifest.h"
#include "PairRuns.h"
#include "allpairs/join/Join.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::join {

/// How space is cut for a set of boxes, and how many go where.
struct Division {
  partition::Partition cells{};
  std::vector<std::uint64_t> counts{};  ///< Of each cell, and of the wide boxes.
  std::uint64_t pairs = 0;              ///< Estimated.

  [[nodiscard]] std::uint64_t copies(std::uint64_t boxes) const;
};

/// Cuts space so that the boxes of a cell fit in memory where cuts can do that, and counts what each cell gets.
///
/// Bad input: a NaN throws FileError.
class Divider {
 public:
  Divider(BoxInput& input, const JoinOptions& options, const Budget& budget);

  [[nodiscard]] Division divide();

 private:
  void count(Division& division);
  [[nodiscard]] bool cutFullCells(Division& division, const std::vector<Box>& sample) const;
  [[nodiscard]] std::uint64_t estimatePairs() const;

  BoxInput& m_input;
  const JoinOptions& m_options;
  const Budget& m_budget;
  std::vector<Box> m_evenSample;  ///< Boxes at equal distances in the input, taken while counting.
};

/// Finds the cells that a box goes to.
class CellFinder {
 public:
  CellFinder(const partition::Partition& cells, double distance);

  /// The numbers of the cells; of a box in many, that of the wide ones alone, which is the number after the last.
  [[nodiscard]] std::span<const std::uint32_t> cellsOf(const Box& box);

 private:
  const partition::Partition& m_cells;
  double m_distance;
  std::size_t m_most;
  std::vector<std::uint32_t> m_found;
};

/// A join on disk, step by step.
class DiskJoin {
 public:
  DiskJoin(BoxInput& input, std::vector<InputState> states, const JoinOptions& options, const Budget& budget,
           bool isCount);

  /// Writes the result to the sink, which a count has none of.
  JoinSummary run(const ResultSink* sink);

 private:
  void openFolder();
  void readManifest();
  void clearFolder();
  void requireRoom(const Division& division) const;
  void distribute();
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
  [[nodiscard]] RecordType recordType() const { return {m_input.isFloat64()}; }
  [[nodiscard]] std::size_t pairSize() const { return pairSizeFor(m_input.size()); }
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
