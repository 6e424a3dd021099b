// SPDX-License-Identifier: MIT
#include "Since.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_set>
#include <utility>

#include "Text.h"
#include "allpairs/Error.h"

namespace allpairs::view {
namespace {

/// Whether it has the form of a UUID: it becomes the name of a folder.
bool isGuid(std::string_view text) {
  constexpr std::string_view kForm = "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx";
  constexpr std::string_view kHexDigits = "0123456789abcdef";
  return std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), [&](char c, char form) {
    return form == 'x' ? kHexDigits.find(c) != std::string_view::npos : c == form;
  });
}

/// The fields of the next record, which is taken off the text (RFC 4180).
std::vector<std::string> takeRecord(std::string_view& text) {
  std::vector<std::string> fields(1);
  bool isQuoted = false;
  while (!text.empty()) {
    const char c = text.front();
    text.remove_prefix(1);
    if (c == '"') {
      const bool isDouble = isQuoted && text.starts_with('"');
      if (isDouble) fields.back() += '"';
      if (isDouble) text.remove_prefix(1);
      if (!isDouble) isQuoted = !isQuoted;
    } else if (c == ',' && !isQuoted) {
      fields.emplace_back();
    } else if (c == '\r' && !isQuoted && text.starts_with('\n')) {
      continue;  // as spreadsheets end lines
    } else if (c == '\n' && !isQuoted) {
      break;
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

/// Without the apostrophe that keeps a spreadsheet from taking a name for a formula.
std::string nameOf(std::string cell) {
  const bool isMarked = cell.starts_with('\'') && looksLikeFormula(std::string_view(cell).substr(1));
  return isMarked ? cell.substr(1) : cell;
}

/// The names of a report's columns, which are taken off the text; none where it is no report's.
std::vector<std::string> takeHead(std::string_view& text) {
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
  if (text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
  std::vector<std::string> head = takeRecord(text);
  const bool isReport = head.size() > 3 && head[0] == "number" && head[1] == "first" && head[2] == "second" &&
                        std::find(head.begin(), head.end(), "guid") != head.end();
  if (!isReport) head.clear();
  return head;
}

}  // namespace

bool isReportCsv(std::string_view text) { return !takeHead(text).empty(); }

std::vector<EarlierClash> readReportCsv(std::string_view text) {
  const std::vector<std::string> head = takeHead(text);
  if (head.empty()) throw Error("is no table of a report: its first line is another");
  const auto guid = static_cast<std::size_t>(std::find(head.begin(), head.end(), "guid") - head.begin());
  std::vector<EarlierClash> rows;
  std::set<std::string> known;
  while (!text.empty()) {
    std::vector<std::string> fields = takeRecord(text);
    if (fields.size() != head.size() || !isGuid(fields[guid]))
      throw Error("is no table of a report: a line has other columns");
    const bool isResolved = fields[0].empty();  // before that report already
    if (!isResolved && known.insert(fields[guid]).second)
      rows.push_back({fields[guid], nameOf(std::move(fields[1])), nameOf(std::move(fields[2]))});
  }
  return rows;
}

Since compareWith(const std::vector<EarlierClash>& earlier, std::string name, std::span<Clash> clashes) {
  std::unordered_set<std::string> before;
  for (const EarlierClash& clash : earlier) before.insert(clash.guid);
  Since since{.name = std::move(name)};
  std::unordered_set<std::string> now;
  for (Clash& clash : clashes) {
    clash.isNew = !before.contains(clash.guid);
    ++(*clash.isNew ? since.added : since.persisting);
    now.insert(clash.guid);
  }
  for (const EarlierClash& clash : earlier) {
    if (!now.contains(clash.guid)) since.resolved.push_back(clash);
  }
  return since;
}

std::string countText(const Since& since) {
  return fmt::format("{} new, {} persisting, {} resolved", since.added, since.persisting, since.resolved.size());
}

}  // namespace allpairs::view
