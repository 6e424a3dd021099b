// SPDX-License-Identifier: MIT
#include "report/ReportFolder.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "Report.h"
#include "Since.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/FolderNames.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/SignalCleanup.h"
#include "cli/Text.h"
#include "cli/TextParts.h"

namespace allpairs::app {

namespace fs = std::filesystem;

namespace {

std::string textOf(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return {};
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Whether it has the table of a report of ours, if not more, as where the writing was interrupted.
bool holdsTable(const fs::path& folder) { return view::isReportCsv(textOf(folder / "clashes.csv")); }

bool holdsReport(const fs::path& folder) {
  return holdsTable(folder) && textOf(folder / "index.html").find("allpairs") != std::string::npos;
}

/// Whether it is a folder that is not empty, as far as it can be read.
bool isFull(const fs::path& folder) {
  std::error_code ignored;
  return !scene::folderNames(folder, ignored).empty();
}

/// Whether a name is that of a file such as a report consists of, and so hardly that of a folder.
bool looksLikeFile(const fs::path& folder) {
  constexpr std::array<std::string_view, 4> kSuffixes{".html", ".htm", ".csv", ".bcf"};
  return std::find(kSuffixes.begin(), kSuffixes.end(), lowerExtension(folder.string())) != kSuffixes.end();
}

[[noreturn]] void failToWrite(const fs::path& folder, std::error_code problem) {
  std::error_code ignored;
  const bool isThere = fs::is_directory(folder, ignored);
  throw FileError::ofSystem(folder, isThere ? "cannot be written to" : "cannot create this folder", problem);
}

/// Throws unless files and folders can be made in it, or, where it is not there, in the nearest one above that is.
void checkMayWrite(const fs::path& folder) {
  std::error_code ignored;
  fs::path there = folder;
  while (!there.empty() && !fs::exists(fs::symlink_status(there, ignored))) there = there.parent_path();
  if (there.empty()) there = ".";
  if (::access(there.c_str(), W_OK | X_OK) != 0) failToWrite(folder, {errno, std::generic_category()});
}

}  // namespace

std::vector<fs::path> filesOfReport(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* const name : {"index.html", "view.html", "clashes.csv", "clashes.bcf", "clashes.bcf.js"})
    files.push_back(folder / name);
  std::error_code ignored;
  for (const std::string& name : scene::folderNames(folder / "pictures", ignored)) {
    if (lowerExtension(name) == ".png") files.push_back(folder / "pictures" / name);
  }
  return files;
}

void checkReportFolder(const fs::path& folder, bool force) {
  std::error_code ignored;
  if (looksLikeFile(folder) && !fs::exists(folder, ignored))
    throw UsageError("-o: '" + folder.string() + "': a report is a folder, which holds index.html and clashes.bcf");
  const auto isFile = [&ignored](const fs::path& path) {  // or a device
    return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
  };
  if (isFile(folder)) throw FileError(folder, "is a file; -o takes a folder");
  for (fs::path above = folder; above.has_relative_path(); above = above.parent_path()) {
    if (isFile(above)) {
      throw FileError(folder, "cannot create this folder: '" + above.string() + "' is a file");
    }
  }
  if (isFull(folder) && !force && !holdsReport(folder)) {
    throw FileError(folder, "is not empty and holds no report; --force writes one into it all the same");
  }
  checkMayWrite(folder);
  if (fs::is_directory(folder / "pictures", ignored)) checkMayWrite(folder / "pictures");
}

/// What the first constructor has made is destroyed where the second one throws.
ReportFolder::ReportFolder(const fs::path& folder) : ReportFolder() {
  m_folder = folder;
  m_stage = folder / (".report-" + std::to_string(::getpid()));
  m_hadReport = holdsTable(m_folder);
  makeFolder(m_stage / "pictures");
}

ReportFolder::~ReportFolder() {
  std::error_code ignored;  // a folder that others write into meanwhile is not empty, and stays
  for (auto path = m_new.rbegin(); path != m_new.rend(); ++path) fs::remove(*path, ignored);
}

/// Makes a folder, and those above it, and notes which are new.
void ReportFolder::makeFolder(const fs::path& folder) {
  std::error_code problem;
  if (fs::is_directory(folder, problem)) return;
  const fs::path above = folder.has_filename() ? folder.parent_path() : folder.parent_path().parent_path();
  if (!above.empty()) makeFolder(above);
  noteNew(folder);  // before it is there: there may be no memory then
  if (!fs::create_directory(folder, problem)) m_new.pop_back();
  if (problem) failToWrite(m_folder, problem);
}

void ReportFolder::noteNew(const fs::path& path) {
  m_new.push_back(path);
  removeOnSignal(path.string());
}

void ReportFolder::write(const fs::path& name, std::string_view bytes) {
  write(name, [bytes](scene::ByteSink sink) { sink(bytes); });
}

void ReportFolder::write(const fs::path& name, const std::function<void(scene::ByteSink)>& writer) {
  try {
    Output output(m_stage / name);
    TextParts parts(output);
    writer([&parts](std::string_view bytes) { parts.write(bytes); });
    parts.flush();
    m_names.push_back(name);
    noteNew(m_stage / name);
    output.commit();
  } catch (const FileError& problem) {
    throw FileError(m_folder / name, problem.problem());
  }
}

/// What could keep a file from its place, as far as that can be known before the first one is there.
void ReportFolder::checkPlaces() const {
  for (const fs::path& name : m_names) {
    if (fs::is_directory(m_folder / name)) throw FileError(m_folder / name, "is a folder; a report has a file there");
  }
}

/// What takes memory comes before the first file is in its place.
void ReportFolder::commit(std::size_t pictures, bool hasPage) {
  checkPlaces();
  std::vector<std::pair<fs::path, fs::path>> moves;
  for (const fs::path& name : m_names) moves.emplace_back(m_stage / name, m_folder / name);
  std::error_code problem;
  std::vector<fs::path> left;  // of the report that is replaced
  if (m_hadReport) {
    if (!hasPage) left.push_back(m_folder / "view.html");
    for (;;) {
      const fs::path picture = m_folder / view::pictureName(++pictures);
      if (!fs::exists(picture, problem)) break;
      left.push_back(picture);
    }
  }
  fs::create_directory(m_folder / "pictures", problem);
  for (const auto& [from, to] : moves) {
    fs::rename(from, to, problem);
    if (problem) throw FileError::ofSystem(to, "cannot be put in its place", problem);
  }
  for (const fs::path& file : left) fs::remove(file, problem);
}

}  // namespace allpairs::app
