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
  BoxView boxes = m_type.isFloat64 ? viewAs<double>() : viewAs<float>();
  if (!m_margins.empty()) boxes.setMargins(m_margins);
  return boxes;
}

template <class Number>
BoxView Records::viewAs() const {
  const auto* numbers = reinterpret_cast<const Number*>(m_words.data() + 1);
  const auto step = static_cast<std::ptrdiff_t>(m_type.size() / sizeof(Number));
  return BoxView::fromStrided(size(), {numbers, step, 1}, {numbers + 3, step, 1});
}

FilterBits Records::bits() const { return {.categories = m_categories, .masks = m_masks, .groups = m_groups}; }

void Records::unpack() const {
  if (m_type.valuesSize() == 0) return;
  const std::size_t values = (sizeof(std::uint64_t) + m_type.boundsSize()) / sizeof(std::uint64_t);
  for (std::size_t i = 0; i < size(); ++i) {
    const auto* from = reinterpret_cast<const std::byte*>(m_words.data() + i * m_type.words() + values);
    const auto take = [&from, i](auto target) {
      if (target.empty()) return;
      std::memcpy(&target[i], from, sizeof(target[i]));
      from += sizeof(target[i]);
    };
    take(m_margins);
    take(m_groups);
    take(m_categories);
    take(m_masks);
  }
}

RecordRoom::RecordRoom(RecordType type, std::size_t records) : m_type(type) {
  m_words = std::make_unique_for_overwrite<std::uint64_t[]>(records * type.words());
  if (type.hasMargins) m_margins = std::make_unique_for_overwrite<double[]>(records);
  if (type.hasGroups) m_groups = std::make_unique_for_overwrite<std::uint32_t[]>(records);
  if (type.hasCategories) m_categories = std::make_unique_for_overwrite<std::uint32_t[]>(records);
  if (type.hasMasks) m_masks = std::make_unique_for_overwrite<std::uint32_t[]>(records);
}

Records RecordRoom::at(std::size_t begin, std::size_t count) const {
  const auto part = [begin, count](const auto& memory) { return std::span(memory.get() + begin, count); };
  Records records;
  records.m_type = m_type;
  records.m_words = {m_words.get() + begin * m_type.words(), count * m_type.words()};
  if (m_margins) records.m_margins = part(m_margins);
  if (m_groups) records.m_groups = part(m_groups);
  if (m_categories) records.m_categories = part(m_categories);
  if (m_masks) records.m_masks = part(m_masks);
  return records;
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

void BoxSpill::add(std::size_t cell, const BoxBlock& block, std::size_t i) {
  Writer& writer = m_writers[cell];
  if (writer.written + writer.used == m_extents[cell].count * m_type.size()) failForCount();
  std::byte* target = m_buffer.data() + cell * m_partSize + writer.used;
  const std::uint64_t id = block.begin + i;
  std::memcpy(target, &id, sizeof(id));
  std::memcpy(target + sizeof(id), boundsOf(block.boxes, i), m_type.boundsSize());
  if (m_type.valuesSize() != 0) writeValues(target + sizeof(id) + m_type.boundsSize(), block, i);
  writer.used += m_type.size();
  if (writer.used == m_partSize) flush(cell);
}

/// In the order in which Records takes them.
void BoxSpill::writeValues(std::byte* target, const BoxBlock& block, std::size_t i) const {
  const auto put = [&target](auto value) {
    std::memcpy(target, &value, sizeof(value));
    target += sizeof(value);
  };
  if (m_type.hasMargins) put(block.boxes.margin(i));
  if (m_type.hasGroups) put(block.group(i));
  if (m_type.hasCategories) put(block.categories(i));
  if (m_type.hasMasks) put(block.mask(i));
  if (m_type.labels() % 2 != 0) put(std::uint32_t{0});
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

bool BoxSpill::isIntact(std::size_t cell, const StopFlag* stop) const {
  const std::uint64_t bytes = m_extents[cell].count * m_type.size();
  return checksumOf(m_file, positionOf(cell), bytes, stop) == m_extents[cell].checksum;
}

void BoxSpill::read(std::size_t cell, std::uint64_t begin, const Records& records) const {
  const std::span<std::uint64_t> words = records.words();
  m_file.read(positionOf(cell) + begin * m_type.size(), words.data(), words.size_bytes());
  records.unpack();
}

}  // namespace allpairs::join
