// SPDX-License-Identifier: MIT
#include "Since.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string>
#include <system_error>
#include <unordered_map>
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

/// Of a table that a spreadsheet saved with other signs between its columns.
std::string separatorHint(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  if (line.find("number;first;second") != std::string_view::npos)
    return "; semicolons separate its columns, not commas";
  if (line.find("number\tfirst\tsecond") != std::string_view::npos) return "; tabs separate its columns, not commas";
  return {};
}

/// The state of a name.
std::optional<ExactState> stateNamed(std::string_view name) {
  for (std::size_t i = 0; i < kExactStates; ++i) {
    if (const auto state = static_cast<ExactState>(i); stateName(state) == name) return state;
  }
  return std::nullopt;
}

/// A finite number; none where the cell has another text.
std::optional<double> numberIn(const std::string& cell) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (problem != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The depth in a cell, if it has a number that is not negative.
std::optional<double> depthIn(const std::string& cell) {
  const std::optional<double> value = numberIn(cell);
  return value && *value >= 0.0 ? value : std::nullopt;
}

/// A point of three cells; none where one of them has no number.
std::optional<std::array<double, 3>> pointIn(const std::string& x, const std::string& y, const std::string& z) {
  const std::array<std::optional<double>, 3> numbers{numberIn(x), numberIn(y), numberIn(z)};
  if (!numbers[0] || !numbers[1] || !numbers[2]) return std::nullopt;
  return std::array{*numbers[0], *numbers[1], *numbers[2]};
}

/// What has become of a row that an earlier report has too.
Change changeOf(const EarlierClash& earlier, const Clash& clash) {
  if (clash.exact == nullptr) return Change::Persisting;
  const bool was = earlier.state && isClash(*earlier.state);  // a pair of boxes was none
  const bool is = isClash(clash.exact->state);
  return was == is ? Change::Persisting : is ? Change::New : Change::Resolved;
}

/// How an earlier report had a row, where that differs: in its state, or by more than a hundredth of its depth.
std::string beforeOf(const EarlierClash& earlier, const Clash& clash) {
  constexpr double kSameDepth = 0.01;
  if (!earlier.state || clash.exact == nullptr) return {};
  const std::optional<double>& depth = clash.exact->depth;
  const bool isDepthKnown = earlier.depth && depth;
  const bool isAsDeep =
      !isDepthKnown || std::abs(*earlier.depth - *depth) <= kSameDepth * std::max(std::abs(*earlier.depth), *depth);
  if (*earlier.state == clash.exact->state && isAsDeep) return {};
  const bool hasDepth = earlier.depth && isClash(*earlier.state);
  return std::string(stateName(*earlier.state)) + (hasDepth ? ", " + shortNumber(*earlier.depth) + " deep" : "");
}

/// Two texts in one order, as one; empty where either is.
std::string keyOf(std::string first, std::string second) {
  if (first.empty() || second.empty()) return {};
  if (second < first) std::swap(first, second);
  return first + '\n' + second;
}

/// Of a model of now, as the table has it.
EarlierPlace placeOf(const ViewScene& scene, std::uint32_t model) {
  return {validUtf8(scene.fileNames[scene.files[model]]), validUtf8(scene.paths[model])};
}

std::string textOf(const EarlierPlace& place) { return place.file.empty() ? "" : place.file + '\n' + place.path; }

/// Without its folders.
std::string_view lastNameOf(std::string_view file) { return file.substr(file.rfind('/') + 1); }

std::string endTextOf(const EarlierPlace& place) { return textOf({std::string(lastNameOf(place.file)), place.path}); }

std::string keyOfPlaces(const std::array<EarlierPlace, 2>& places) {
  return keyOf(textOf(places[0]), textOf(places[1]));
}

/// Of places without folders, and of the point where the two meet; empty where there is none.
std::string keyOfEnds(const std::array<EarlierPlace, 2>& places, const std::optional<std::array<double, 3>>& point) {
  const std::string ends = keyOf(endTextOf(places[0]), endTextOf(places[1]));
  if (ends.empty() || !point) return {};
  const auto [x, y, z] = *point;
  return fmt::format("{}\n{:.9g} {:.9g} {:.9g}", ends, x + 0.0, y + 0.0, z + 0.0);  // 0 for -0
}

/// Whether the folders of one file are the last ones of the other's: of files of one name those count that tell them
/// apart, and so more where another one has come in.
bool isSameButForFirstFolders(const EarlierPlace& a, const EarlierPlace& b) {
  const bool isLonger = a.file.size() > b.file.size();
  const std::string& file = isLonger ? a.file : b.file;
  const std::string& end = isLonger ? b.file : a.file;
  return a.path == b.path && (file == end || file.ends_with('/' + end));
}

bool areSameButForFirstFolders(const std::array<EarlierPlace, 2>& a, const std::array<EarlierPlace, 2>& b) {
  return (isSameButForFirstFolders(a[0], b[0]) && isSameButForFirstFolders(a[1], b[1])) ||
         (isSameButForFirstFolders(a[0], b[1]) && isSameButForFirstFolders(a[1], b[0]));
}

/// Whether a file is none of an earlier row's, and one of these has its name in another folder.
bool isOfAnotherFolder(const std::string& file, const std::array<EarlierPlace, 2>& earlier) {
  const auto isSameFile = [&](const EarlierPlace& place) { return place.file == file; };
  const auto isOfSameName = [&](const EarlierPlace& place) { return lastNameOf(place.file) == lastNameOf(file); };
  return std::none_of(earlier.begin(), earlier.end(), isSameFile) &&
         std::any_of(earlier.begin(), earlier.end(), isOfSameName);
}

/// Whether a row of now may be the earlier one that has its GUID. That one may have kept the GUID of a file of the same
/// name, which is known by other folders now; what is known by a GlobalId is the same, whatever its file.
bool mayBeSame(const ViewScene& scene, const EarlierClash& earlier, const Clash& clash) {
  const auto mayBe = [&](std::uint32_t model) {
    const std::string& file = scene.fileNames[scene.files[model]];
    const std::string identity = identityOf(scene, model);
    const bool isKnownByFile = identity == file || identity.starts_with(file + '\n');
    return !isKnownByFile || !isOfAnotherFolder(placeOf(scene, model).file, earlier.places);
  };
  return scene.files.empty() || (mayBe(clash.first) && mayBe(clash.second));
}

/// Where the two of a row of now meet, as its table says.
std::optional<std::array<double, 3>> pointOf(const Clash& clash) {
  if (clash.exact == nullptr || clash.exact->state == ExactState::NotExamined) return std::nullopt;
  return allpairs::placeOf(*clash.exact);
}

std::string nameTextOf(const ViewScene& scene, std::uint32_t model) { return validUtf8(scene.name(model)); }

/// Finds the row that an earlier report had for each of now.
class RowMatch {
 public:
  RowMatch(const std::vector<EarlierClash>& earlier, const ViewScene& scene, std::span<const Clash> clashes)
      : m_earlier(earlier), m_clashes(clashes), m_found(clashes.size(), nullptr) {
    const auto any = [](const EarlierClash& /*before*/, const Clash& /*clash*/) { return true; };
    matchBy([](const EarlierClash& clash) { return clash.guid; }, [](const Clash& clash) { return clash.guid; },
            [&](const EarlierClash& before, const Clash& clash) { return mayBeSame(scene, before, clash); });
    if (scene.files.empty()) return;
    const auto placesOf = [&scene](const Clash& clash) {
      return std::array{placeOf(scene, clash.first), placeOf(scene, clash.second)};
    };
    matchBy([](const EarlierClash& clash) { return keyOfPlaces(clash.places); },
            [&](const Clash& clash) { return keyOfPlaces(placesOf(clash)); }, any);
    matchBy([](const EarlierClash& clash) { return keyOfEnds(clash.places, clash.point); },
            [&](const Clash& clash) { return keyOfEnds(placesOf(clash), pointOf(clash)); },
            [&](const EarlierClash& before, const Clash& clash) {
              return areSameButForFirstFolders(before.places, placesOf(clash));
            });
    matchBy([](const EarlierClash& clash) { return keyOf(clash.first, clash.second); },
            [&](const Clash& clash) { return keyOf(nameTextOf(scene, clash.first), nameTextOf(scene, clash.second)); },
            any);
  }

  [[nodiscard]] const EarlierClash* of(std::size_t clash) const { return m_found[clash]; }
  [[nodiscard]] bool isGone(const EarlierClash& clash) const { return !m_taken.contains(&clash); }

 private:
  /// The rows that have a key, of those that have no match yet.
  struct Keyed {
    std::size_t earlierRows = 0;
    std::size_t rows = 0;
    const EarlierClash* earlier = nullptr;
    std::size_t row = 0;
  };

  /// Matches an earlier row and one of now that alone have a key, where isMatch() says so of the two.
  template <class EarlierKey, class Key, class IsMatch>
  void matchBy(const EarlierKey& earlierKey, const Key& key, const IsMatch& isMatch) {
    std::unordered_map<std::string, Keyed> keys;
    for (const EarlierClash& clash : m_earlier) {
      if (!isGone(clash)) continue;
      Keyed& keyed = keys[earlierKey(clash)];
      ++keyed.earlierRows;
      keyed.earlier = &clash;
    }
    for (std::size_t i = 0; i < m_clashes.size(); ++i) {
      if (m_found[i] != nullptr) continue;
      Keyed& keyed = keys[key(m_clashes[i])];
      ++keyed.rows;
      keyed.row = i;
    }
    keys.erase("");
    for (const auto& [text, keyed] : keys) {
      if (keyed.earlierRows != 1 || keyed.rows != 1 || !isMatch(*keyed.earlier, m_clashes[keyed.row])) continue;
      m_found[keyed.row] = keyed.earlier;
      m_taken.insert(keyed.earlier);
    }
  }

  const std::vector<EarlierClash>& m_earlier;
  std::span<const Clash> m_clashes;
  std::vector<const EarlierClash*> m_found;
  std::unordered_set<const EarlierClash*> m_taken;
};

}  // namespace

bool isReportCsv(std::string_view text) { return !takeHead(text).empty(); }

std::vector<EarlierClash> readReportCsv(std::string_view text) {
  const std::string hint = separatorHint(text);
  const std::vector<std::string> head = takeHead(text);
  if (head.empty()) throw Error("is no table of a report: its first line is another" + hint);
  const auto columnOf = [&head](std::string_view name) {
    return static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin());
  };
  const std::size_t guid = columnOf("guid");
  const std::size_t state = columnOf("state");
  const std::size_t depth = columnOf("depth");
  const std::array<std::size_t, 3> point{columnOf("x"), columnOf("y"), columnOf("z")};
  const std::array<std::array<std::size_t, 2>, 2> places{
      {{columnOf("first_file"), columnOf("first_path")}, {columnOf("second_file"), columnOf("second_path")}}};
  std::vector<EarlierClash> rows;
  std::set<std::string> known;
  for (std::size_t number = 2; !text.empty(); ++number) {
    std::vector<std::string> fields = takeRecord(text);
    if (fields.size() != head.size() || !isGuid(fields[guid]))
      throw Error("is no table of a report: a line has other columns (row " + std::to_string(number) + ")");
    const bool isResolved = fields[0].empty();  // before that report already
    if (isResolved || !known.insert(fields[guid]).second) continue;
    EarlierClash& row = rows.emplace_back();
    if (state < head.size()) row.state = stateNamed(fields[state]);
    if (depth < head.size()) row.depth = depthIn(fields[depth]);
    if (std::max({point[0], point[1], point[2]}) < head.size())
      row.point = pointIn(fields[point[0]], fields[point[1]], fields[point[2]]);
    row.guid = std::move(fields[guid]);
    for (std::size_t i = 0; i < row.places.size(); ++i) {
      const auto [file, path] = places[i];
      if (std::max(file, path) < head.size())
        row.places[i] = {nameOf(std::move(fields[file])), nameOf(std::move(fields[path]))};
    }
    row.first = nameOf(std::move(fields[1]));
    row.second = nameOf(std::move(fields[2]));
  }
  return rows;
}

Since compareWith(const std::vector<EarlierClash>& earlier, std::string name, const ViewScene& scene,
                  std::span<Clash> clashes) {
  const RowMatch match(earlier, scene, clashes);
  std::unordered_set<std::string_view> earlierGuids;
  for (const EarlierClash& clash : earlier) earlierGuids.insert(clash.guid);
  Since since{.name = std::move(name)};
  for (std::size_t i = 0; i < clashes.size(); ++i) {
    Clash& clash = clashes[i];
    const EarlierClash* const before = match.of(i);
    clash.since = before == nullptr ? Change::New : changeOf(*before, clash);
    if (before != nullptr) clash.before = beforeOf(*before, clash);
    if (before != nullptr) clash.guid = before->guid;
    if (before == nullptr) {
      while (earlierGuids.contains(clash.guid)) clash.guid = guidOf({clash.guid, "another"});
    }
    ++(*clash.since == Change::New          ? since.added
       : *clash.since == Change::Persisting ? since.persisting
                                            : since.resolved);
  }
  for (const EarlierClash& clash : earlier) {
    if (match.isGone(clash)) since.gone.push_back(clash);
  }
  since.resolved += since.gone.size();
  return since;
}

std::string_view changeName(Change change) {
  return change == Change::New ? "new" : change == Change::Persisting ? "persisting" : "resolved";
}

std::string countText(const Since& since) {
  return fmt::format("{} new, {} persisting, {} resolved", since.added, since.persisting, since.resolved);
}

}  // namespace allpairs::view
