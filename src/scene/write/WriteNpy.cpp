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

void writeNpy(const ResultView& result, ByteSink sink) {
  TextBuffer out(sink);
  out.append(npyPairsHeader(result.pairs.size()));
  for (const Pair pair : result.pairs) {
    appendLittleEndian(out, result.swapped ? pair.second : pair.first);
    appendLittleEndian(out, result.swapped ? pair.first : pair.second);
  }
  out.flush();
}

}  // namespace allpairs::scene
