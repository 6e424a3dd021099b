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

constexpr std::size_t kBlock = std::size_t{1} << 14;  // boxes that are read at once: they stay in the cache
constexpr std::size_t kNeighbors = 4;                 // boxes of a sample that are read at one place

template <class Number>
BoxView viewOf(const scene::BoxRows& file, std::uint64_t begin, std::span<const Number> rows) {
  try {
    return BoxView::fromRows(rows);
  } catch (const InvalidBox& problem) {
    throw FileError(file.path(), "box " + std::to_string(begin + problem.index()) + " has a NaN");
  }
}

}  // namespace

BoxInput::BoxInput(std::span<const std::filesystem::path> first, std::span<const std::filesystem::path> second)
    : m_paths(first.begin(), first.end()), m_firstFiles(first.size()) {
  m_paths.insert(m_paths.end(), second.begin(), second.end());
  for (std::size_t k = 0; k < m_paths.size(); ++k) {
    const scene::BoxRows file(m_paths[k]);
    m_sizes.push_back(file.size());
    m_setSizes[setOf(k)] += file.size();
    m_isFloat64 = m_isFloat64 || file.isFloat64();
  }
}

scene::BoxRows BoxInput::open(std::size_t file) const {
  scene::BoxRows rows(m_paths[file]);
  if (rows.size() != m_sizes[file] || (rows.isFloat64() && !m_isFloat64)) {
    throw FileError(m_paths[file], "changed while it was read");
  }
  return rows;
}

void BoxInput::forEachBlock(Visitor visit) {
  std::vector<float> float32;
  std::vector<double> float64;
  if (m_isFloat64) {
    readBlocks(float64, visit);
  } else {
    readBlocks(float32, visit);
  }
}

template <class Number>
void BoxInput::readBlocks(std::vector<Number>& rows, Visitor visit) {
  std::array<std::uint64_t, 2> read{};  // boxes of each set in the files before
  for (std::size_t k = 0; k < m_paths.size(); ++k) {
    scene::BoxRows file = open(k);
    const std::size_t set = setOf(k);
    for (std::uint64_t begin = 0; begin < file.size(); begin += kBlock) {
      rows.resize(6 * static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, file.size() - begin)));
      file.read(begin, std::span(rows));
      visit({set, read[set] + begin, read[0] + read[1] + begin, viewOf(file, begin, std::span<const Number>(rows))});
    }
    read[set] += file.size();
  }
}

std::vector<Box> BoxInput::sample(std::size_t count) {
  return m_isFloat64 ? sampleAs<double>(count) : sampleAs<float>(count);
}

template <class Number>
std::vector<Box> BoxInput::sampleAs(std::size_t count) {
  std::vector<Box> boxes;
  std::vector<Number> rows;
  const std::uint64_t step = size() <= count ? kNeighbors : size() / std::max<std::size_t>(count / kNeighbors, 1);
  for (std::size_t k = 0; k < m_paths.size(); ++k) {
    scene::BoxRows file = open(k);
    for (std::uint64_t begin = 0; begin < file.size(); begin += step) {
      rows.resize(6 * static_cast<std::size_t>(std::min<std::uint64_t>(kNeighbors, file.size() - begin)));
      file.read(begin, std::span(rows));
      const BoxView view = viewOf(file, begin, std::span<const Number>(rows));
      for (std::size_t i = 0; i < view.size(); ++i) boxes.push_back(view[i]);
    }
  }
  return boxes;
}

}  // namespace allpairs::join
