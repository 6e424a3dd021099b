// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "Checksum.h"
#include "WorkFile.h"
#include "allpairs/BoxView.h"

namespace allpairs::join {

/// A box on disk: its number in 64 bits, and six numbers.
struct RecordType {
  bool isFloat64 = false;

  [[nodiscard]] std::size_t boundsSize() const noexcept { return 6 * (isFloat64 ? sizeof(double) : sizeof(float)); }
  [[nodiscard]] std::size_t size() const noexcept { return sizeof(std::uint64_t) + boundsSize(); }
  [[nodiscard]] std::size_t words() const noexcept { return size() / sizeof(std::uint64_t); }
};

/// Some records, in memory that somebody else owns.
class Records {
 public:
  Records(RecordType type, std::span<std::uint64_t> words) : m_type(type), m_words(words) {}

  [[nodiscard]] std::size_t size() const noexcept { return m_words.size() / m_type.words(); }
  [[nodiscard]] BoxView boxes() const;
  [[nodiscard]] std::uint64_t id(std::size_t i) const noexcept { return m_words[i * m_type.words()]; }
  [[nodiscard]] std::span<std::uint64_t> words() const noexcept { return m_words; }

 private:
  RecordType m_type;
  std::span<std::uint64_t> m_words;
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

  /// Adds box i of a block, whose number is `id`, to a cell.
  void add(std::size_t cell, std::uint64_t id, const BoxView& block, std::size_t i);

  /// Writes what is left; nothing is added after this.
  void finish();

  [[nodiscard]] RecordType type() const noexcept { return m_type; }
  [[nodiscard]] const std::vector<Extent>& extents() const noexcept { return m_extents; }

  /// Whether the boxes of a cell are those that were written.
  [[nodiscard]] bool isIntact(std::size_t cell) const;

  /// Reads the boxes of a cell from `begin` on, as many as there is room for.
  void read(std::size_t cell, std::uint64_t begin, const Records& records) const;

 private:
  struct Writer {
    std::size_t used = 0;       ///< Bytes in its part of the buffer.
    std::uint64_t written = 0;  ///< Bytes in the file.
    Checksum checksum{};
  };

  void flush(std::size_t cell);
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
