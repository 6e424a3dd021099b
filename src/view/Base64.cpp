// SPDX-License-Identifier: MIT
#include "Base64.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace allpairs::view {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Up to three bytes as four characters.
void encode(std::string_view bytes, std::string& text) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    bits = bits << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    text += i <= bytes.size() ? kDigits[bits >> (18U - 6U * i) & 63U] : '=';
  }
}

}  // namespace

void writeBase64(std::string_view bytes, scene::ByteSink sink) {
  constexpr std::size_t kBatch = 3 << 16;
  std::string text;
  for (std::size_t begin = 0; begin < bytes.size(); begin += kBatch) {
    text.clear();
    const std::string_view batch = bytes.substr(begin, kBatch);
    for (std::size_t i = 0; i < batch.size(); i += 3) encode(batch.substr(i, 3), text);
    sink(text);
  }
}

}  // namespace allpairs::view
