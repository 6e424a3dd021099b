// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "BoxBlock.h"
#include "Checksum.h"
#include "RecordType.h"
#include "WorkFile.h"
#include "allpairs/BoxView.h"
#include "allpairs/Filter.h"
#include "allpairs/StopFlag.h"

namespace allpairs::join {

/// Some records, in memory that a RecordRoom owns.
class Records {
 public:
  [[nodiscard]] std::size_t size() const noexcept { return m_words.size() / m_type.words(); }
  [[nodiscard]] BoxView boxes() const;
  [[nodiscard]] FilterBits bits() const;
  [[nodiscard]] std::uint64_t id(std::size_t i) const noexcept { return m_words[i * m_type.words()]; }
  [[nodiscard]] std::span<std::uint64_t> words() const noexcept { return m_words; }

  /// Brings together what the search reads of the records beside bounds.
  void unpack() const;

 private:
  friend class RecordRoom;

  template <class Number>
  [[nodiscard]] BoxView viewAs() const;

  RecordType m_type{};
  std::span<std::uint64_t> m_words{};
  std::span<double> m_margins{};  ///< These are empty where records have none.
  std::span<std::uint32_t> m_groups{};
  std::span<std::uint32_t> m_categories{};
  std::span<std::uint32_t> m_masks{};
};

/// Memory for records. Pages that are not written to are no memory.
class RecordRoom {
 public:
  RecordRoom(RecordType type, std::size_t records);

  /// The records [begin, begin + count) of it.
  [[nodiscard]] Records at(std::size_t begin, std::size_t count) const;

 private:
  RecordType m_type;
  std::unique_ptr<std::uint64_t[]> m_words;
  std::unique_ptr<double[]> m_margins;
  std::unique_ptr<std::uint32_t[]> m_groups;
  std::unique_ptr<std::uint32_t[]> m_categories;
  std::unique_ptr<std::uint32_t[]> m_masks;
};

/// Where the boxes of one cell lie in the file.
struct Extent {
  std::uint64_t begin = 0;  ///< Records before it.
  std::uint64_t count = 0;
  std::uint64_t checksum = 0;
};

/// The boxes of all cells in one file: those of a cell one after the other, in the order of their numbers.
class BoxSpill {
 public:
  /// A new file for as many boxes in each cell.
  BoxSpill(const std::filesystem::path& path, RecordType type, std::span<const std::uint64_t> counts,
           std::size_t bufferBytes);

  /// A file that is complete.
  BoxSpill(const std::filesystem::path& path, RecordType type, std::vector<Extent> extents);

  /// Adds box i of a block to a cell.
  void add(std::size_t cell, const BoxBlock& block, std::size_t i);

  /// Writes what is left; nothing is added after this.
  void finish();

  [[nodiscard]] RecordType type() const noexcept { return m_type; }
  [[nodiscard]] const std::vector<Extent>& extents() const noexcept { return m_extents; }

  /// Whether the boxes of a cell are those that were written.
  [[nodiscard]] bool isIntact(std::size_t cell, const StopFlag* stop) const;

  /// Reads the boxes of a cell from `begin` on, as many as there is room for.
  void read(std::size_t cell, std::uint64_t begin, const Records& records) const;

 private:
  struct Writer {
    std::size_t used = 0;       ///< Bytes in its part of the buffer.
    std::uint64_t written = 0;  ///< Bytes in the file.
    Checksum checksum{};
  };

  void flush(std::size_t cell);
  void writeValues(std::byte* target, const BoxBlock& block, std::size_t i) const;
  [[noreturn]] void failForCount() const;
  [[nodiscard]] std::uint64_t positionOf(std::size_t cell) const { return m_extents[cell].begin * m_type.size(); }

  RecordType m_type;
  WorkFile m_file;
  std::vector<Extent> m_extents;
  std::size_t m_partSize = 0;
  std::vector<std::byte> m_buffer;  ///< A part for each cell.
  std::vector<Writer> m_writers;
};

}  // namespace allpairs::join
