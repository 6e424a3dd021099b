// SPDX-License-Identifier: MIT
#include <string>

#include "allpairs/scene/WriteResult.h"
#include "write/TextBuffer.h"

namespace allpairs::scene {
namespace {

bool needsQuotes(const std::string& name) {
  if (name.empty()) return true;
  const bool hasSpaceAtEnd = name.front() == ' ' || name.back() == ' ';
  return hasSpaceAtEnd || name.front() == '#' || name.find_first_of(",\"\r\n\t") != std::string::npos;
}

}  // namespace

std::string csvField(const std::string& name) {
  if (!needsQuotes(name)) return name;
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

void writeCsv(const ResultView& result, ByteSink sink) {
  TextBuffer out(sink);
  out.append("first,second\n");
  for (const Pair pair : result.pairs) {
    out.append(csvField(result.model(result.swapped ? pair.second : pair.first).name));
    out.append(",");
    out.append(csvField(result.model(result.swapped ? pair.first : pair.second).name));
    out.append("\n");
  }
  out.flush();
}

}  // namespace allpairs::scene
