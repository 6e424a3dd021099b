// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "allpairs/Span.h"

namespace allpairs::scene {

/// A NumPy file of boxes that is read a part at a time: an array of shape (n, 6), float32 or float64, either byte
/// order, C or Fortran order, of any length.
///
/// Bad input: anything else throws FileError. NaNs are the reader's to find.
/// Cost:      nothing is kept but the header: the file is read where it is asked for, not mapped, so that its pages do
///            not count as memory of the process, and a file that is cut short while in use is an error, not a signal.
/// Threads:   one call at a time.
class BoxRows {
 public:
  explicit BoxRows(const std::filesystem::path& path);
  ~BoxRows();
  BoxRows(BoxRows&&) noexcept;
  BoxRows& operator=(BoxRows&&) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const noexcept;
  [[nodiscard]] std::uint64_t size() const noexcept;
  [[nodiscard]] bool isFloat64() const noexcept;

  /// Reads the boxes from `begin` on, as many as fit, in rows of minx miny minz maxx maxy maxz. As float32 only of a
  /// file that is.
  ///
  /// Bad input: a range that is not within the file, or float32 of a float64 file, throws InvalidArgument; a file that
  ///            cannot be read throws FileError.
  void read(std::uint64_t begin, Span<float> rows);
  void read(std::uint64_t begin, Span<double> rows);

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::scene
