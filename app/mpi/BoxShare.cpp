// SPDX-License-Identifier: MIT
#include "mpi/BoxShare.h"

#include <algorithm>
#include <string>

#include "allpairs/scene/BoxRows.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::app {

BoxShare::BoxShare(const BoxFiles& files, int rank, int ranks) : m_paths(files.paths) {
  for (const auto& path : files.paths) {
    const scene::BoxRows file(path);
    m_allBoxes += file.size();
    m_ends.push_back(m_allBoxes);
    m_isFloat64 = m_isFloat64 || file.isFloat64();
  }
  const auto beginOf = [&](int which) {  // without a product that overflows
    const auto count = static_cast<std::uint64_t>(ranks);
    const auto number = static_cast<std::uint64_t>(which);
    return m_allBoxes / count * number + std::min(m_allBoxes % count, number);
  };
  m_begin = beginOf(rank);
  m_end = beginOf(rank + 1);
  if (m_isFloat64) {
    read(m_float64);
  } else {
    read(m_float32);
  }
  m_margins = valuesOf<double>(files.values.margins, scene::BoxValue::Margin);
  m_groups = valuesOf<std::uint32_t>(files.values.groups, scene::BoxValue::Group);
  m_categories = valuesOf<std::uint32_t>(files.values.categories, scene::BoxValue::Category);
  m_masks = valuesOf<std::uint32_t>(files.values.masks, scene::BoxValue::Mask);
}

template <class Number>
std::vector<Number> BoxShare::valuesOf(std::span<const std::filesystem::path> paths, scene::BoxValue kind) const {
  if (paths.empty()) return {};
  std::vector<Number> numbers(static_cast<std::size_t>(m_end - m_begin));
  scene::BoxValues(paths, kind, m_allBoxes).read(m_begin, numbers);
  return numbers;
}

template <class Number>
void BoxShare::read(std::vector<Number>& rows) {
  rows.resize(6 * static_cast<std::size_t>(m_end - m_begin));
  std::uint64_t fileBegin = 0;
  for (std::size_t i = 0; i < m_paths.size(); ++i) {
    const std::uint64_t begin = std::max(m_begin, fileBegin);
    const std::uint64_t end = std::min(m_end, m_ends[i]);
    if (begin < end) {
      scene::BoxRows file(m_paths[i]);
      if (file.size() != m_ends[i] - fileBegin) throw FileError(m_paths[i], "changed while it was read");
      file.read(begin - fileBegin, std::span(rows).subspan(6 * (begin - m_begin), 6 * (end - begin)));
    }
    fileBegin = m_ends[i];
  }
}

FilterBits BoxShare::bits() const { return {.categories = m_categories, .masks = m_masks, .groups = m_groups}; }

BoxView BoxShare::view() const {
  try {
    BoxView boxes = m_isFloat64 ? BoxView::fromRows(m_float64) : BoxView::fromRows(m_float32);
    boxes.setMargins(m_margins);
    return boxes;
  } catch (const InvalidBox& problem) {
    fail(problem);
  }
}

scene::EmptyBoxes BoxShare::empty() const {
  scene::EmptyBoxes empty;
  empty.look(view(), m_begin);
  return empty;
}

void BoxShare::fail(const InvalidBox& problem) const {
  const std::uint64_t box = m_begin + problem.index();
  const auto file = std::upper_bound(m_ends.begin(), m_ends.end(), box) - m_ends.begin();
  const std::uint64_t before = file == 0 ? 0 : m_ends[static_cast<std::size_t>(file) - 1];
  throw FileError(m_paths[static_cast<std::size_t>(file)], problem.messageOf(box - before));
}

}  // namespace allpairs::app
