// SPDX-License-Identifier: MIT
#include "cli/NpyOutput.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "allpairs/scene/WriteResult.h"
#include "cli/ExitStatus.h"

namespace allpairs::app {

void refuseTerminal(const Output& output) {
  if (!output.isTerminal()) return;
  throw UsageError("--format npy is binary and is not written to a terminal: use -o FILE, or redirect the output");
}

NpyOutput::NpyOutput(Output& output, std::string_view type, const std::vector<std::uint64_t>& shape)
    : m_output(output) {
  m_output.write(scene::npyHeader(type, shape));
}

template <class Number>
void NpyOutput::addAny(std::span<const Number> numbers) {
  if constexpr (std::endian::native == std::endian::little) {
    m_output.write({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
    return;
  }
  m_bytes.resize(numbers.size_bytes());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    char* bytes = m_bytes.data() + i * sizeof(Number);
    std::memcpy(bytes, &numbers[i], sizeof(Number));
    std::reverse(bytes, bytes + sizeof(Number));
  }
  m_output.write(m_bytes);
}

void NpyOutput::add(std::span<const std::uint32_t> numbers) { addAny(numbers); }
void NpyOutput::add(std::span<const float> numbers) { addAny(numbers); }
void NpyOutput::add(std::span<const double> numbers) { addAny(numbers); }

}  // namespace allpairs::app
