// SPDX-License-Identifier: MIT
#include "BoxSpill.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "allpairs/scene/FileError.h"

namespace allpairs::join {
namespace {

constexpr std::size_t kMostPart = std::size_t{1} << 20;  // bytes: more at once are not written faster

/// The bounds of a box as the caller's memory has them; boxes of an input are rows.
const void* boundsOf(const BoxView& rows, std::size_t i) {
  if (rows.isFloat64()) return rows.float64().min.data + 6 * i;
  return rows.float32().min.data + 6 * i;
}

}  // namespace

BoxView Records::boxes() const {
  if (m_words.empty()) return {};
  const auto stride = static_cast<std::ptrdiff_t>(m_type.size());
  if (m_type.isFloat64) {
    const auto* numbers = reinterpret_cast<const double*>(m_words.data() + 1);
    const auto step = stride / static_cast<std::ptrdiff_t>(sizeof(double));
    return BoxView::fromStrided(size(), {numbers, step, 1}, {numbers + 3, step, 1});
  }
  const auto* numbers = reinterpret_cast<const float*>(m_words.data() + 1);
  const auto step = stride / static_cast<std::ptrdiff_t>(sizeof(float));
  return BoxView::fromStrided(size(), {numbers, step, 1}, {numbers + 3, step, 1});
}

BoxSpill::BoxSpill(const std::filesystem::path& path, RecordType type, std::span<const std::uint64_t> counts,
                   std::size_t bufferBytes)
    : m_type(type), m_file(path, WorkFile::Mode::Create), m_extents(counts.size()), m_writers(counts.size()) {
  std::uint64_t begin = 0;
  for (std::size_t cell = 0; cell < counts.size(); ++cell) {
    m_extents[cell] = {begin, counts[cell], 0};
    begin += counts[cell];
  }
  const std::size_t records = std::min(bufferBytes / counts.size(), kMostPart) / type.size();
  m_partSize = std::max<std::size_t>(records, 1) * type.size();
  m_buffer.resize(m_partSize * counts.size());
}

BoxSpill::BoxSpill(const std::filesystem::path& path, RecordType type, std::vector<Extent> extents)
    : m_type(type), m_file(path, WorkFile::Mode::Open), m_extents(std::move(extents)) {}

void BoxSpill::add(std::size_t cell, std::uint64_t id, const BoxView& block, std::size_t i) {
  Writer& writer = m_writers[cell];
  if (writer.written + writer.used == m_extents[cell].count * m_type.size()) failForCount();
  std::byte* target = m_buffer.data() + cell * m_partSize + writer.used;
  std::memcpy(target, &id, sizeof(id));
  std::memcpy(target + sizeof(id), boundsOf(block, i), m_type.boundsSize());
  writer.used += m_type.size();
  if (writer.used == m_partSize) flush(cell);
}

void BoxSpill::failForCount() const {
  throw FileError(m_file.path(), "gets other boxes than were counted: an input changed while it was read");
}

void BoxSpill::flush(std::size_t cell) {
  Writer& writer = m_writers[cell];
  const std::byte* bytes = m_buffer.data() + cell * m_partSize;
  writer.checksum.add(bytes, writer.used);
  m_file.write(positionOf(cell) + writer.written, bytes, writer.used);
  writer.written += writer.used;
  writer.used = 0;
}

void BoxSpill::finish() {
  for (std::size_t cell = 0; cell < m_writers.size(); ++cell) {
    flush(cell);
    if (m_writers[cell].written != m_extents[cell].count * m_type.size()) failForCount();
    m_extents[cell].checksum = m_writers[cell].checksum.value();
  }
  m_writers.clear();
  m_buffer = std::vector<std::byte>();
}

bool BoxSpill::isIntact(std::size_t cell) const {
  return checksumOf(m_file, positionOf(cell), m_extents[cell].count * m_type.size()) == m_extents[cell].checksum;
}

void BoxSpill::read(std::size_t cell, std::uint64_t begin, const Records& records) const {
  const std::span<std::uint64_t> words = records.words();
  m_file.read(positionOf(cell) + begin * m_type.size(), words.data(), words.size_bytes());
}

}  // namespace allpairs::join
