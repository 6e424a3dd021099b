// SPDX-License-Identifier: MIT
#include <array>
#include <bit>

#include "allpairs/scene/WriteResult.h"
#include "boxes/NpyHeader.h"
#include "write/TextBuffer.h"

namespace allpairs::scene {
namespace {

void appendLittleEndian(TextBuffer& out, std::uint32_t value) {
  const std::array<char, 4> bytes{static_cast<char>(value & 0xff), static_cast<char>(value >> 8 & 0xff),
                                  static_cast<char>(value >> 16 & 0xff), static_cast<char>(value >> 24)};
  out.append({bytes.data(), bytes.size()});
}

}  // namespace

std::string npyHeader(std::string_view type, Span<const std::uint64_t> shape) {
  constexpr std::size_t kBefore = 10;  // magic, version, and the length of the text in 16 bits
  constexpr std::size_t kAlignment = 64;
  std::string text =
      "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': " + shapeText(shape) + ", }";
  while ((kBefore + text.size() + 1) % kAlignment != 0) text += ' ';
  text += '\n';
  std::string header(kNpyMagic);
  header += {1, 0, static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return header + text;
}

void writeNpy(const ResultView& result, ByteSink sink) {
  TextBuffer out(sink);
  out.append(npyHeader("<u4", std::array<std::uint64_t, 2>{result.pairs.size(), 2}));
  for (const Pair pair : result.pairs) {
    appendLittleEndian(out, result.swapped ? pair.second : pair.first);
    appendLittleEndian(out, result.swapped ? pair.first : pair.second);
  }
  out.flush();
}

}  // namespace allpairs::scene
