// SPDX-License-Identifier: MIT
#include "input/TextScanner.h"

#include <algorithm>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"

namespace allpairs::scene {

TextScanner::TextScanner(const std::filesystem::path& path, const StopFlag* stop)
    : TextScanner(path, readText(path, stop), stop) {
  refuseUtf16(m_text, path);
}

TextScanner::TextScanner(const std::filesystem::path& path, std::string text, const StopFlag* stop)
    : m_path(path), m_text(std::move(text)), m_stop(stop) {}

std::string_view TextScanner::word() {
  checkStop(m_stop);
  auto text = rest();
  const auto word = takeWord(text, isBlankOrLineEnd);
  m_position = m_text.size() - text.size();
  m_wordStart = m_position - word.size();
  return word;
}

std::string_view TextScanner::wordInLine() {
  const auto begin = m_text.find_first_not_of(kBlanks, m_position);
  if (begin == std::string::npos || m_text[begin] == '\n') return {};
  return word();
}

double TextScanner::number() {
  const auto word = this->word();
  if (word.empty()) fail("a number is missing");
  const auto value = parseFinite(word);
  if (!value) fail("what stands here is not a finite number");
  return *value;
}

std::array<double, 3> TextScanner::point() {
  std::array<double, 3> coordinates{};
  for (double& coordinate : coordinates) coordinate = number();
  return coordinates;
}

std::int64_t TextScanner::integer() {
  const auto word = this->word();
  if (word.empty()) fail("an integer is missing");
  std::int64_t value{};
  if (parseWhole(word, value) != std::errc{}) fail("what stands here is not an integer");
  return value;
}

void TextScanner::expect(std::string_view wanted) {
  if (word() != wanted) fail("expected '" + std::string{wanted} + "'");
}

void TextScanner::skipLine() {
  const auto end = m_text.find('\n', m_position);
  m_position = end == std::string::npos ? m_text.size() : end + 1;
}

void TextScanner::skipComments() {
  for (;; skipLine()) {
    const auto begin = std::min(m_text.find_first_not_of(" \t\r\f\v\n", m_position), m_text.size());
    const bool isAtLineBegin = begin == 0 || m_text[begin - 1] == '\n';
    if (!isAtLineBegin || begin == m_text.size() || m_text[begin] != '#') return;
    m_position = begin;
  }
}

std::string_view TextScanner::bytes(std::size_t count) {
  checkStop(m_stop);
  if (m_text.size() - m_position < count) fail("the file ends before its data");
  m_wordStart = m_position;
  m_position += count;
  return std::string_view{m_text}.substr(m_position - count, count);
}

void TextScanner::fail(const std::string& problem) const {
  const auto upTo = m_text.begin() + static_cast<std::ptrdiff_t>(std::min(m_wordStart, m_text.size()));
  throw FileError(m_path, problem, static_cast<std::size_t>(std::count(m_text.begin(), upTo, '\n')) + 1);
}

}  // namespace allpairs::scene
