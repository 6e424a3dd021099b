// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "allpairs/scene/WriteResult.h"

namespace allpairs::app {

/// Fails before the work that a report needs where the folder cannot be: a file is in its place, it may not be
/// written to or made, or, unless it is forced, it holds something else than an earlier report.
///
/// Bad input: throws FileError; a new folder that is called like a file of a report, UsageError.
void checkReportFolder(const std::filesystem::path& folder, bool force);

/// The files there that a report would replace or take away.
[[nodiscard]] std::vector<std::filesystem::path> filesOfReport(const std::filesystem::path& folder);

/// The files of a report. They are written into a folder beside their places, and commit() puts all of them there; until
/// then an earlier report is whole. Without it nothing is left behind, nor where a signal ends the program.
///
/// Bad input: a folder or file that cannot be made throws FileError.
class ReportFolder {
 public:
  explicit ReportFolder(const std::filesystem::path& folder);
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;
  ReportFolder(ReportFolder&&) = delete;
  ReportFolder& operator=(ReportFolder&&) = delete;

  void write(const std::filesystem::path& name, std::string_view bytes);
  void write(const std::filesystem::path& name, const std::function<void(scene::ByteSink)>& writer);

  /// All is written: puts it in its place. Pictures that an earlier, longer report left there are taken away, and its
  /// page where there is none now.
  void commit(std::size_t pictures, bool hasPage);

 private:
  /// Of nothing yet.
  ReportFolder() = default;

  void makeFolder(const std::filesystem::path& folder);
  void noteNew(const std::filesystem::path& path);
  void checkPlaces() const;

  std::filesystem::path m_folder;
  std::filesystem::path m_stage;
  bool m_hadReport = false;
  std::vector<std::filesystem::path> m_names;  ///< Of the files that are written, within the folder.
  std::vector<std::filesystem::path> m_new;    ///< What is there for the time being, in the order in which it was made.
};

}  // namespace allpairs::app
