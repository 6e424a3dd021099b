// SPDX-License-Identifier: MIT
#include "BoxInput.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::join {
namespace {

constexpr std::uint64_t kBlock = std::uint64_t{1} << 14;  // boxes that are read at once: they stay in the cache
constexpr std::uint64_t kNeighbors = 4;                   // boxes of a sample that are read at one place

template <class Number>
BoxView viewOf(const scene::BoxRows& file, std::uint64_t begin, std::span<const Number> rows) {
  try {
    return BoxView::fromRows(rows);
  } catch (const InvalidBox& problem) {
    throw FileError(file.path(), problem.messageOf(begin + problem.index()));
  }
}

/// Reads some boxes here and there, up to one that is none: all are read in order besides, which throws for the first.
template <class Read>
void upToABadBox(const Read& read) {
  try {
    read();
  } catch (const FileError& problem) {
    if (problem.code()) throw;  // of the system
  }
}

}  // namespace

SetValues::SetValues(const scene::BoxValueFiles& files, std::uint64_t boxes) {
  if (!files.margins.empty()) m_marginFiles.emplace(files.margins, scene::BoxValue::Margin, boxes);
  if (!files.groups.empty()) m_groupFiles.emplace(files.groups, scene::BoxValue::Group, boxes);
  if (!files.categories.empty()) m_categoryFiles.emplace(files.categories, scene::BoxValue::Category, boxes);
  if (!files.masks.empty()) m_maskFiles.emplace(files.masks, scene::BoxValue::Mask, boxes);
}

void SetValues::addTo(RecordType& type) const noexcept {
  type.hasMargins = type.hasMargins || m_marginFiles;
  type.hasGroups = type.hasGroups || m_groupFiles;
  type.hasCategories = type.hasCategories || m_categoryFiles;
  type.hasMasks = type.hasMasks || m_maskFiles;
}

void SetValues::read(std::uint64_t begin, std::size_t count) {
  const auto readFrom = [begin, count](std::optional<scene::BoxValues>& files, auto& values) {
    if (!files) return;
    values.resize(count);
    files->read(begin, values);
  };
  readFrom(m_marginFiles, m_margins);
  readFrom(m_groupFiles, m_groups);
  readFrom(m_categoryFiles, m_categories);
  readFrom(m_maskFiles, m_masks);
}

void SetValues::readMargins(std::uint64_t begin, std::size_t count) {
  m_margins.resize(count);
  m_marginFiles->read(begin, m_margins);
}

BoxInput::BoxInput(std::span<const std::filesystem::path> first, const JoinOptions& options)
    : m_paths(first.begin(), first.end()), m_firstFiles(first.size()) {
  m_paths.insert(m_paths.end(), options.second.begin(), options.second.end());
  for (std::size_t k = 0; k < m_paths.size(); ++k) {
    const scene::BoxRows file(m_paths[k]);
    m_sizes.push_back(file.size());
    m_setSizes[setOf(k)] += file.size();
    m_type.isFloat64 = m_type.isFloat64 || file.isFloat64();
  }
  for (std::size_t set = 0; set < sets(); ++set) takeValues(set, set == 0 ? options.values : options.secondValues);
}

void BoxInput::takeValues(std::size_t set, const scene::BoxValueFiles& files) {
  m_values[set] = SetValues(files, m_setSizes[set]);
  m_values[set].addTo(m_type);
  const auto note = [&](const std::vector<std::filesystem::path>& paths, scene::BoxValue kind) {
    for (const auto& path : paths) m_valuePaths.push_back({4 * set + static_cast<std::uint64_t>(kind), path});
  };
  note(files.margins, scene::BoxValue::Margin);
  note(files.groups, scene::BoxValue::Group);
  note(files.categories, scene::BoxValue::Category);
  note(files.masks, scene::BoxValue::Mask);
}

scene::BoxRows BoxInput::open(std::size_t file) const {
  scene::BoxRows rows(m_paths[file]);
  if (rows.size() != m_sizes[file] || (rows.isFloat64() && !m_type.isFloat64)) {
    throw FileError(m_paths[file], "changed while it was read");
  }
  return rows;
}

void BoxInput::forEachBlock(Visitor visit) { readEach(kBlock, kBlock, visit); }

BoxSample BoxInput::sample(std::size_t count) {
  BoxSample sample{.type = {.hasMargins = m_type.hasMargins}};
  const std::uint64_t step = size() <= count ? kNeighbors : size() / std::max<std::uint64_t>(count / kNeighbors, 1);
  upToABadBox([&] {
    readEach(step, kNeighbors, [&sample](const BoxBlock& block) {
      for (std::size_t i = 0; i < block.boxes.size(); ++i) sample.add(block, i);
    });
  });
  return sample;
}

void BoxInput::readEach(std::uint64_t step, std::uint64_t most, Visitor visit) {
  if (m_type.isFloat64) {
    readEachAs<double>(step, most, visit);
  } else {
    readEachAs<float>(step, most, visit);
  }
}

/// As many boxes as there is room for in `rows`.
template <class Number>
BoxBlock BoxInput::readBlock(scene::BoxRows& file, const Place& place, std::vector<Number>& rows) {
  file.read(place.begin, std::span(rows));
  const std::uint64_t begin = place.before + place.begin;
  BoxBlock block{place.set, begin, (place.set == 0 ? 0 : m_setSizes[0]) + begin,
                 viewOf(file, place.begin, std::span<const Number>(rows))};
  SetValues& values = m_values[place.set];
  values.read(begin, block.boxes.size());
  if (values.hasMargins()) block.boxes.setMargins(values.margins());
  block.bits = values.bits();
  return block;
}

template <class Number>
void BoxInput::readEachAs(std::uint64_t step, std::uint64_t most, Visitor visit) {
  std::vector<Number> rows;
  std::array<std::uint64_t, 2> read{};  // boxes of each set in the files before
  for (std::size_t k = 0; k < m_paths.size(); ++k) {
    scene::BoxRows file = open(k);
    const std::size_t set = setOf(k);
    for (std::uint64_t begin = 0; begin < file.size(); begin += step) {
      rows.resize(6 * static_cast<std::size_t>(std::min(most, file.size() - begin)));
      visit(readBlock(file, {set, read[set], begin}, rows));
    }
    read[set] += file.size();
  }
}

void BoxInput::forEachProbe(std::size_t count, Visitor visit) {
  upToABadBox([&] {
    if (m_type.isFloat64) {
      readProbesAs<double>(count, visit);
    } else {
      readProbesAs<float>(count, visit);
    }
  });
}

template <class Number>
void BoxInput::readProbesAs(std::uint64_t count, Visitor visit) {
  std::vector<Number> rows(6);
  std::array<std::uint64_t, 2> read{};  // boxes of each set in the files before
  std::array<std::uint64_t, 2> next{};  // the probe of each set
  for (std::size_t k = 0; k < m_paths.size(); ++k) {
    scene::BoxRows file = open(k);
    const std::size_t set = setOf(k);
    const std::uint64_t probes = std::min(count, m_setSizes[set]);
    for (; next[set] < probes; ++next[set]) {
      const auto partBegin = [&](std::uint64_t part) {
        return m_setSizes[set] / probes * part + m_setSizes[set] % probes * part / probes;
      };
      const std::uint64_t begin = partBegin(next[set]);
      // Multiples of the golden ratio, in 64 bits.
      const std::uint64_t place =
          begin + ((next[set] + 1) * 0x9E3779B97F4A7C15ULL >> 20U) % (partBegin(next[set] + 1) - begin);
      if (place >= read[set] + file.size()) break;
      visit(readBlock(file, {set, read[set], place - read[set]}, rows));
    }
    read[set] += file.size();
  }
}

std::span<const double> BoxInput::margins(std::size_t set, std::uint64_t begin) {
  const std::uint64_t count = std::min(kBlock, m_setSizes[set] - begin);
  m_values[set].readMargins(begin, static_cast<std::size_t>(count));
  return m_values[set].margins();
}

}  // namespace allpairs::join
