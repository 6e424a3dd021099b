// SPDX-License-Identifier: MIT
#include "cli/NpyOutput.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace allpairs::app {
namespace {

/// The start of a NumPy file, version 1.0: the numbers that follow it begin at a multiple of 64 bytes.
std::string npyHeader(std::string_view type, const std::vector<std::uint64_t>& shape) {
  std::string text = "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': (";
  for (const std::uint64_t extent : shape) text += std::to_string(extent) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  text += "), }";
  constexpr std::size_t kBefore = 10;  // Magic, version and the length of the text.
  constexpr std::size_t kAlignment = 64;
  while ((kBefore + text.size() + 1) % kAlignment != 0) text += ' ';
  text += '\n';
  const std::size_t length = text.size();
  const std::string start{
      '\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, static_cast<char>(length % 256), static_cast<char>(length / 256)};
  return start + text;
}

}  // namespace

NpyOutput::NpyOutput(Output& output, std::string_view type, const std::vector<std::uint64_t>& shape)
    : m_output(output) {
  m_output.write(npyHeader(type, shape));
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
