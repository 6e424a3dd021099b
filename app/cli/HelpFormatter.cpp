// SPDX-License-Identifier: MIT
#include "cli/HelpFormatter.h"

#include <unistd.h>

#include <CLI/StringTools.hpp>
#include <algorithm>
#include <sstream>
#include <vector>

#include "cli/Terminal.h"

namespace allpairs::app {
namespace {

constexpr std::size_t kLeast = 28;  // a narrower column has no room for words
constexpr std::size_t kIndent = 4;  // of lines that go on

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    text.remove_prefix(end + 1);
  }
}

/// The words of a line; what is quoted is part of one, and so is the value of an option.
std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  bool isQuoted = false;
  bool takesValue = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '\'') isQuoted = !isQuoted;
    if (i < line.size() && (isQuoted || line[i] != ' ')) continue;
    const std::string_view word = line.substr(begin, i - begin);
    if (takesValue && !word.empty() && word.front() != '-') {
      const auto first = static_cast<std::size_t>(words.back().data() - line.data());
      words.back() = line.substr(first, i - first);
      takesValue = false;
    } else if (!word.empty()) {
      words.push_back(word);
      takesValue = word.front() == '-';
    }
    begin = i + 1;
  }
  return words;
}

/// Fills lines with help.
class Filler {
 public:
  explicit Filler(std::size_t width) : m_width(width) {}

  void line(std::string_view text) {
    const std::size_t indent = std::min(text.find_first_not_of(' '), text.size());
    if (indent == 0 && !text.empty()) {
      m_paragraph += (m_paragraph.empty() ? "" : " ") + std::string(text);
      return;
    }
    endParagraph();
    if (indent == text.size()) {
      m_text += '\n';
    } else if (indent > kDeepest) {
      add({m_column, m_column}, text);  // more of the column above
    } else {
      entry(text, indent);
    }
  }

  std::string finish() {
    endParagraph();
    m_text.pop_back();
    return std::move(m_text);
  }

 private:
  static constexpr std::size_t kDeepest = 8;  // columns that a line of its own is indented

  /// A line that is indented: a name or a command, with what it does behind it where there is room.
  void entry(std::string_view text, std::size_t indent) {
    const std::size_t end = text.find("  ", indent);
    const std::string_view name = text.substr(0, end);
    if (end == std::string_view::npos) return add({indent, indent + kIndent}, name, endOf(name));
    m_column = text.find_first_not_of(' ', end);
    if (m_column + kLeast <= m_width)
      return add({indent, m_column}, text.substr(m_column), "", text.substr(indent, m_column - indent));
    add({indent, indent + kIndent}, name, endOf(name));
    add({indent + kIndent, indent + kIndent}, text.substr(m_column));
    m_column = indent + kIndent;
  }

  static std::string_view endOf(std::string_view name) {
    return name.find("allpairs ") == std::string_view::npos ? "" : " \\";
  }

  void endParagraph() {
    if (!m_paragraph.empty()) add({0, 0}, m_paragraph);
    m_paragraph.clear();
  }

  /// Where the first line of a text begins, and where the others do.
  struct Indents {
    std::size_t first = 0;
    std::size_t rest = 0;
  };

  /// A text whose first line begins behind `head`; `end` says that more comes.
  void add(Indents indents, std::string_view text, std::string_view end = "", std::string_view head = "") {
    std::string line = std::string(indents.first, ' ') + std::string(head);
    bool isBegin = true;
    for (const std::string_view word : wordsOf(text)) {
      if (!isBegin && columnsOf(line) + 1 + columnsOf(word) + end.size() > m_width) {
        m_text.append(line).append(end) += '\n';
        line = std::string(indents.rest, ' ');
        isBegin = true;
      }
      line.append(isBegin ? "" : " ").append(word);
      isBegin = false;
    }
    m_text += line + '\n';
  }

  std::size_t m_width;
  std::size_t m_column = 0;  ///< Where what the last name does begins.
  std::string m_paragraph;
  std::string m_text;
};

}  // namespace

std::string filled(std::string_view text, std::size_t width) {
  const std::vector<std::string_view> lines = linesOf(text);
  if (std::all_of(lines.begin(), lines.end(), [width](auto line) { return columnsOf(line) <= width; }))
    return std::string(text);
  Filler filler(width);
  for (const std::string_view line : lines) filler.line(line);
  return filler.finish();
}

HelpFormatter::HelpFormatter() : m_width(terminalWidth(STDOUT_FILENO)) {
  constexpr std::size_t kNarrowest = 10;  // of the left column
  if (!m_width) return;
  const std::size_t room = *m_width - std::min(*m_width, kLeast);
  column_width(std::clamp(room, kNarrowest, get_column_width()));
}

std::string HelpFormatter::wrappedBesideNames(const std::string& text) const {
  if (!m_width) return text;
  return wrapped(text, std::max(kLeast, *m_width - std::min(*m_width, get_column_width())));
}

std::string HelpFormatter::filledToWidth(const std::string& text) const {
  return m_width ? filled(text, *m_width) : text;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrappedBesideNames(CLI::Formatter::make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::ostringstream text;
  CLI::detail::format_help(text, command->get_name(), wrappedBesideNames(command->get_description()),
                           get_column_width());
  return text.str();
}

std::string HelpFormatter::make_description(const CLI::App* command) const {
  return filledToWidth(CLI::Formatter::make_description(command));
}

std::string HelpFormatter::make_usage(const CLI::App* command, std::string name) const {
  return filledToWidth(CLI::Formatter::make_usage(command, std::move(name)));
}

std::string HelpFormatter::make_footer(const CLI::App* command) const {
  return filledToWidth(CLI::Formatter::make_footer(command));
}

}  // namespace allpairs::app
