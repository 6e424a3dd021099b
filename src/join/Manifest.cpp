// SPDX-License-Identifier: MIT
#include "Manifest.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "Checksum.h"
#include "WorkFile.h"
#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::join {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFirstLine = "allpairs join 2\n";  // the form of the file

/// A line of a word and whole numbers; doubles are their bits, signed numbers in two's complement.
template <class... Numbers>
void addLine(std::string& text, std::string_view word, Numbers... numbers) {
  text += word;
  ((text += ' ', text += std::to_string(static_cast<std::uint64_t>(numbers))), ...);
  text += '\n';
}

std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value); }

std::string textOf(const Manifest& manifest) {
  std::string text(kFirstLine);
  for (const InputState& input : manifest.inputs) addLine(text, "input", input.path, input.bytes, input.changed);
  addLine(text, "options", bitsOf(manifest.distance), manifest.isCount);
  if (manifest.secondFiles != 0) addLine(text, "second", manifest.secondFiles);
  for (const auto& [kind, file] : manifest.values) addLine(text, "value", kind, file.path, file.bytes, file.changed);
  if (manifest.region) {
    const auto [x0, y0, z0] = manifest.region->min;
    const auto [x1, y1, z1] = manifest.region->max;
    addLine(text, "region", bitsOf(x0), bitsOf(y0), bitsOf(z0), bitsOf(x1), bitsOf(y1), bitsOf(z1));
  }
  if (manifest.outside != 0) addLine(text, "outside", manifest.outside);
  for (std::size_t set = 0; set < manifest.empty.size(); ++set) {
    const auto& [count, first, axis] = manifest.empty[set];
    if (count != 0) addLine(text, "empty", set, count, first, axis);
  }
  for (const partition::Cut& cut : manifest.cuts) {
    addLine(text, "cut", bitsOf(cut.at), cut.axis, cut.low, cut.high);
  }
  for (const Extent& extent : manifest.extents) addLine(text, "boxes", extent.begin, extent.count, extent.checksum);
  for (const auto& [number, result] : manifest.cells) {
    addLine(text, "cell", number, result.pairs);
    for (const Run& run : result.runs) addLine(text, "run", run.position, run.pairs, run.checksum);
  }
  addLine(text, "checksum", checksumOf(text));
  return text;
}

/// The lines of a manifest, one after the other. Braces call number() from left to right.
class Lines {
 public:
  explicit Lines(std::string_view text) : m_text(text) {}

  [[nodiscard]] bool next() {
    if (m_text.empty()) return false;
    const std::size_t end = std::min(m_text.find('\n'), m_text.size() - 1);
    m_line = m_text.substr(0, end);
    m_text.remove_prefix(end + 1);
    m_word = m_line.substr(0, m_line.find(' '));
    m_line.remove_prefix(m_word.size());
    return true;
  }

  [[nodiscard]] std::string_view word() const { return m_word; }

  std::uint64_t number() {
    std::uint64_t value = 0;
    if (m_line.empty()) throw InvalidArgument("a number is missing");
    m_line.remove_prefix(1);
    const auto [end, problem] = std::from_chars(m_line.data(), m_line.data() + m_line.size(), value);
    if (problem != std::errc()) throw InvalidArgument("what should be a number is none");
    m_line.remove_prefix(static_cast<std::size_t>(end - m_line.data()));
    return value;
  }

 private:
  std::string_view m_text;
  std::string_view m_line;
  std::string_view m_word;
};

void readLine(Lines& line, Manifest& manifest, CellResult*& cell) {
  if (line.word() == "input") {
    manifest.inputs.push_back({line.number(), line.number(), static_cast<std::int64_t>(line.number())});
  } else if (line.word() == "options") {
    manifest.distance = std::bit_cast<double>(line.number());
    manifest.isCount = line.number() != 0;
  } else if (line.word() == "second") {
    manifest.secondFiles = static_cast<std::size_t>(line.number());
  } else if (line.word() == "value") {
    manifest.values.push_back(
        {line.number(), {line.number(), line.number(), static_cast<std::int64_t>(line.number())}});
  } else if (line.word() == "region") {
    const auto bound = [&line] { return std::bit_cast<double>(line.number()); };
    manifest.region = Box{{bound(), bound(), bound()}, {bound(), bound(), bound()}};
  } else if (line.word() == "outside") {
    manifest.outside = line.number();
  } else if (line.word() == "empty") {
    scene::EmptyBoxes& empty = manifest.empty[line.number() == 0 ? 0 : 1];
    empty = {line.number(), line.number(), static_cast<std::size_t>(line.number())};
  } else if (line.word() == "cut") {
    manifest.cuts.push_back({std::bit_cast<double>(line.number()), static_cast<std::uint32_t>(line.number()),
                             static_cast<std::int32_t>(line.number()), static_cast<std::int32_t>(line.number())});
  } else if (line.word() == "boxes") {
    manifest.extents.push_back({line.number(), line.number(), line.number()});
  } else if (line.word() == "cell") {
    cell = &manifest.cells[static_cast<std::size_t>(line.number())];
    cell->pairs = line.number();
  } else if (line.word() == "run" && cell != nullptr) {
    cell->runs.push_back({line.number(), line.number(), line.number()});
  } else {
    throw InvalidArgument("a line of another kind");
  }
}

InputState stateOf(const fs::path& path) {
  std::error_code problem;
  const std::uintmax_t size = fs::file_size(path, problem);
  const fs::file_time_type changed = problem ? fs::file_time_type() : fs::last_write_time(path, problem);
  if (problem) throw FileError::ofSystem(path, "cannot be read", problem);
  return {checksumOf(fs::absolute(path).lexically_normal().string()), size, changed.time_since_epoch().count()};
}

Manifest manifestOf(std::string_view text) {
  Manifest manifest;
  CellResult* cell = nullptr;
  Lines lines(text);
  while (lines.next()) readLine(lines, manifest, cell);
  return manifest;
}

}  // namespace

void Manifest::write(const fs::path& path) const {
  const std::string text = textOf(*this);
  const fs::path next = path.string() + ".next";
  {
    const WorkFile file(next, WorkFile::Mode::Create);
    file.write(0, text.data(), text.size());
    file.sync();  // a name is on disk before bytes are, and would be that of an empty file after a loss of power
  }
  std::error_code problem;
  fs::rename(next, path, problem);
  if (problem) throw FileError::ofSystem(path, "cannot be replaced", problem);
}

void Manifest::check() const {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 48;
  (void)partition::Partition::fromCuts(cuts);
  for (const scene::EmptyBoxes& of : empty) {
    if (of.axis > 2) throw InvalidArgument("boxes that are empty on no axis");
  }
  if (secondFiles > inputs.size()) throw InvalidArgument("a second set of other files");
  const std::size_t tasks = cuts.size() + 2;  // cells, and the wide boxes
  if (extents.size() != (secondFiles == 0 ? tasks : 2 * tasks))
    throw InvalidArgument("another number of cells than its cuts make");
  std::uint64_t boxes = 0;
  for (const Extent& extent : extents) {
    if (extent.begin != boxes || extent.count > kMost - boxes) throw InvalidArgument("cells that overlap");
    boxes += extent.count;
  }
  for (const auto& [number, result] : cells) {
    std::uint64_t pairs = 0;
    for (const Run& run : result.runs) {
      if (run.position > kMost || run.pairs > kMost - pairs) throw InvalidArgument("runs that end nowhere");
      pairs += run.pairs;
    }
    if (number >= tasks || (!isCount && pairs != result.pairs)) throw InvalidArgument("pairs of no cell");
  }
}

std::optional<Manifest> Manifest::read(const fs::path& path) {
  if (isAbsent(path)) return std::nullopt;
  const WorkFile file(path, WorkFile::Mode::Open);
  std::error_code unknown;
  const std::uintmax_t size = fs::file_size(path, unknown);
  if (unknown) throw FileError::ofSystem(path, "cannot be read", unknown);
  std::string text(static_cast<std::size_t>(size), '\0');
  file.read(0, text.data(), text.size());
  const std::size_t end = text.rfind("checksum ");
  const std::string_view content = std::string_view(text).substr(0, end == std::string::npos ? 0 : end);
  std::string last;
  addLine(last, "checksum", checksumOf(content));
  const bool isWhole = content.starts_with(kFirstLine) && text.substr(content.size()) == last;
  try {
    if (!isWhole) throw InvalidArgument("its checksum is another");
    Manifest manifest = manifestOf(content.substr(kFirstLine.size()));
    manifest.check();
    return manifest;
  } catch (const InvalidArgument& problem) {
    throw FileError(path, std::string("is damaged: remove its folder and join anew (") + problem.what() + ")");
  }
}

std::vector<InputState> statesOf(std::span<const fs::path> paths) {
  std::vector<InputState> states;
  for (const fs::path& path : paths) states.push_back(stateOf(path));
  return states;
}

std::vector<ValueState> statesOf(std::span<const ValuePath> paths) {
  std::vector<ValueState> states;
  for (const ValuePath& values : paths) states.push_back({values.kind, stateOf(values.path)});
  return states;
}

}  // namespace allpairs::join
