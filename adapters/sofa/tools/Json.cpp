// SPDX-License-Identifier: MIT
#include "Json.h"

#include <cmath>
#include <cstdio>

namespace allpairs::tools {

std::string quoted(const std::string& text) {
  constexpr unsigned char kFirstPrintable = 0x20;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < kFirstPrintable ? '?' : c;
  }
  return result + '"';
}

std::string jsonNumber(double value) {
  if (std::isnan(value)) return "\"nan\"";
  if (std::isinf(value)) return value < 0.0 ? "\"-inf\"" : "\"inf\"";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace allpairs::tools
