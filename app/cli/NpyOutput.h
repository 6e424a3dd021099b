// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/Output.h"

namespace allpairs::app {

/// Throws UsageError where --format npy would go to a terminal.
void refuseTerminal(const Output& output);

/// Writes a NumPy array, C order, little-endian, as its numbers come: as many as the shape says.
class NpyOutput {
 public:
  /// `type` as NumPy names it: "<u4", "<f4", "<f8".
  NpyOutput(Output& output, std::string_view type, const std::vector<std::uint64_t>& shape);

  void add(std::span<const std::uint32_t> numbers);
  void add(std::span<const float> numbers);
  void add(std::span<const double> numbers);

 private:
  template <class Number>
  void addAny(std::span<const Number> numbers);

  Output& m_output;
  std::string m_bytes;
};

}  // namespace allpairs::app
