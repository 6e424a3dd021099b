// SPDX-License-Identifier: MIT
#include "allpairs/scene/BoxArray.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "allpairs/Error.h"
#include "boxes/CsvLine.h"
#include "boxes/NpyInput.h"
#include "input/FileBytes.h"
#include "input/ReadScope.h"
#include "input/UniqueNames.h"

namespace allpairs::scene {
namespace {

template <class T>
BoxView viewOf(const BoxTable<T>& table) {
  const auto size = static_cast<std::ptrdiff_t>(table.size);
  if (size == 0) return {};
  const T* values = table.values.get();
  if (!table.columnMajor) return BoxView::fromRows(std::span<const T>(values, table.size * 6));
  return BoxView::fromStrided(table.size, CornerView<T>{values, 1, size}, CornerView<T>{values + 3 * size, 1, size});
}

template <class T>
T* writeRow(T* row, const Box& box) {
  row = std::transform(box.min.begin(), box.min.end(), row, [](double value) { return static_cast<T>(value); });
  return std::transform(box.max.begin(), box.max.end(), row, [](double value) { return static_cast<T>(value); });
}

}  // namespace

BoxArray::BoxArray(BoxTable<float> table, std::string label, NameList names)
    : m_table(std::move(table)), m_boxes(viewOf(std::get<BoxTable<float>>(m_table))) {
  m_parts.push_back({0, std::move(label), std::move(names)});
}

BoxArray::BoxArray(BoxTable<double> table, std::string label, NameList names, std::vector<LineNote> notes)
    : m_table(std::move(table)), m_boxes(viewOf(std::get<BoxTable<double>>(m_table))), m_notes(std::move(notes)) {
  m_parts.push_back({0, std::move(label), std::move(names)});
}

std::string BoxArray::name(std::size_t i) const {
  const auto after = std::upper_bound(m_parts.begin(), m_parts.end(), i,
                                      [](std::size_t index, const Part& part) { return index < part.begin; });
  const Part& part = *std::prev(after);
  const std::size_t index = i - part.begin;
  if (!part.names.empty() && !part.names[index].empty()) return std::string(part.names[index]);
  return m_parts.size() == 1 ? std::to_string(index) : part.label + '[' + std::to_string(index) + ']';
}

template <class T>
BoxArray BoxArray::concatenateAs(std::vector<BoxArray> arrays, std::size_t size) {
  BoxTable<T> table{std::make_unique_for_overwrite<T[]>(size * 6), size};
  std::vector<Part> parts;
  UniqueNames labels;  // files of one name may lie in several folders
  T* row = table.values.get();
  for (BoxArray& array : arrays) {
    const auto before = static_cast<std::size_t>(row - table.values.get()) / 6;
    for (Part& part : array.m_parts) {
      part.begin += before;
      part.label = labels.unique(part.label);
      parts.push_back(std::move(part));
    }
    for (std::size_t i = 0; i < array.size(); ++i) row = writeRow(row, array.m_boxes[i]);
    array = {};
  }
  BoxArray result(std::move(table), {});
  result.m_parts = std::move(parts);
  return result;
}

BoxArray BoxArray::concatenate(std::vector<BoxArray> arrays) {
  if (arrays.empty()) return {};
  if (arrays.size() == 1) return std::move(arrays.front());
  std::size_t size = 0;
  bool anyFloat64 = false;
  for (const BoxArray& array : arrays) {
    size += array.size();
    anyFloat64 |= array.boxes().isFloat64();
  }
  return anyFloat64 ? concatenateAs<double>(std::move(arrays), size) : concatenateAs<float>(std::move(arrays), size);
}

bool isBoxArrayFile(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".npy" || extension == ".csv";
}

BoxArray readBoxArray(const std::filesystem::path& path, const ReadOptions& options) {
  if (options.progress) options.progress({.done = 0, .total = 1, .file = path});
  ReadScope scope(path, options);
  if (lowerExtension(path) == ".csv") return readCsv(path, scope);
  scope.admit(path);  // twice its size is more than it takes
  return readNpy(path, scope.stop());
}

}  // namespace allpairs::scene
