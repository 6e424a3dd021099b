// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "allpairs/Span.h"

namespace allpairs::scene {

/// What a number of a box is: BoxView::setMargins() and FilterBits say what each does.
enum class BoxValue : std::uint8_t { Margin, Group, Category, Mask };

/// Files of what the boxes of a set have beside their bounds: of each, none, or some whose numbers are one for each
/// box.
struct BoxValueFiles {
  std::vector<std::filesystem::path> margins{};
  std::vector<std::filesystem::path> groups{};
  std::vector<std::filesystem::path> categories{};
  std::vector<std::filesystem::path> masks{};
};

/// NumPy files of one number for each box that are read a part at a time: arrays of shape (n,), in either byte order,
/// taken one after the other. Margins are float16, float32, float64 or integers, all else are integers of any width;
/// bools count as 0 and 1.
///
/// Bad input: anything else, and more or fewer numbers than boxes, throw FileError.
/// Cost:      one file is open at a time; nothing is kept but the headers' sizes.
/// Threads:   one call at a time.
class BoxValues {
 public:
  /// The numbers of so many boxes.
  BoxValues(Span<const std::filesystem::path> paths, BoxValue kind, std::uint64_t boxes);
  ~BoxValues();
  BoxValues(BoxValues&&) noexcept;
  BoxValues& operator=(BoxValues&&) noexcept;

  /// Reads the numbers from that of box `begin` on, as many as fit.
  ///
  /// Bad input: a range that is not within the files, or numbers of the other kind, throws InvalidArgument; a margin
  ///            that is a NaN or -infinity, a label beyond 32 bits, an integer margin beyond 2^53, and a file that
  ///            cannot be read or has changed, throw FileError, which names the file and the number in it.
  void read(std::uint64_t begin, Span<double> margins);
  void read(std::uint64_t begin, Span<std::uint32_t> labels);

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::scene
