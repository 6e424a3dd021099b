// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/scene/ReadOptions.h"

namespace allpairs::scene {

/// The numbers of n boxes in one block of memory, in the order of minx miny minz maxx maxy maxz.
template <class T>
struct BoxTable {
  std::unique_ptr<T[]> values;  ///< 6 n of them.
  std::size_t size = 0;
  bool columnMajor = false;  ///< Six columns of n, in Fortran order, instead of n rows of six.
};

/// Many short texts in one block of memory.
class NameList {
 public:
  void add(std::string_view name) {
    m_text += name;
    m_ends.push_back(m_text.size());
  }

  [[nodiscard]] bool empty() const noexcept { return m_ends.empty(); }

  [[nodiscard]] std::string_view operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : m_ends[i - 1];
    return std::string_view(m_text).substr(begin, m_ends[i] - begin);
  }

 private:
  std::string m_text;
  std::vector<std::uint64_t> m_ends;
};

/// A line of a text that may not be what it was taken for.
struct LineNote {
  std::size_t line = 0;
  std::string reason;
};

/// The boxes of a file, float32 or float64, in one block, with names if the file has them.
///
/// Threads: const use from any number of threads.
class BoxArray {
 public:
  BoxArray() = default;

  /// Bad input: a NaN throws InvalidBox.
  BoxArray(BoxTable<float> table, std::string label, NameList names = {});
  BoxArray(BoxTable<double> table, std::string label, NameList names = {}, std::vector<LineNote> notes = {});

  /// A view of the boxes that stays valid when the array is moved, but not longer than it lives.
  [[nodiscard]] const BoxView& boxes() const noexcept { return m_boxes; }
  [[nodiscard]] std::size_t size() const noexcept { return m_boxes.size(); }

  /// The name of box i: its name in the file, else its index. With several files, the index follows the file's name,
  /// and a number if several files have that name: a.npy[7], a.npy#2[7].
  [[nodiscard]] std::string name(std::size_t i) const;

  /// The lines of its file to warn of; of an array that was made of several there are none.
  [[nodiscard]] const std::vector<LineNote>& notes() const noexcept { return m_notes; }

  /// One array of all the boxes, in the order given: float32 if all are, else float64, which holds both exactly.
  [[nodiscard]] static BoxArray concatenate(std::vector<BoxArray> arrays);

 private:
  struct Part {
    std::size_t begin = 0;
    std::string label;
    NameList names;
  };

  template <class T>
  static BoxArray concatenateAs(std::vector<BoxArray> arrays, std::size_t size);

  std::variant<BoxTable<float>, BoxTable<double>> m_table;
  BoxView m_boxes;
  std::vector<Part> m_parts;
  std::vector<LineNote> m_notes;
};

/// Reads boxes from a NumPy file: an array of shape (n, 6), float32 or float64, either byte order, C or Fortran order,
/// format versions 1 to 3.
///
/// Bad input: anything else throws FileError: another type or shape, a file that is shorter or longer than its header
///            says, a NaN.
/// Cost:      one read; the memory of the numbers. Nothing is allocated for data that only the header promises.
[[nodiscard]] BoxArray readNpy(const std::filesystem::path& path);

/// Reads boxes from lines of text: minx,miny,minz,maxx,maxy,maxz, as float64.
///
/// The first or the last column may be a name. A first line that names the columns may put them in another order, also
/// as a comment, if as many columns follow; one that numbers those behind the name, as pandas does, is none of boxes.
/// Empty lines and lines that begin with # are skipped; notes tell of one that may be a box with such a name, and of one
/// that names the columns in another order but is no header.
/// Bad input: throws FileError with line and column; also for a file that is not text, such as UTF-16.
[[nodiscard]] BoxArray readCsv(const std::filesystem::path& path);

/// Whether the path has the extension of a box array: .npy or .csv.
[[nodiscard]] bool isBoxArrayFile(const std::filesystem::path& path);

/// Reads .npy or .csv.
[[nodiscard]] BoxArray readBoxArray(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace allpairs::scene
