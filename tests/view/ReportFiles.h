// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <zip.h>

#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/TempFolder.h"

namespace allpairs::test {

namespace fs = std::filesystem;

inline const std::string kDemoScene = ALLPAIRS_SOURCE_DIR "/examples/scenes/demo.scn";

/// The vertices and the face of a triangle in an OBJ file, which may have more before.
inline const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 1\nf -3 -2 -1\n";

/// All files of a zip archive by their names.
inline std::map<std::string, std::string> filesOf(const fs::path& path) {
  std::map<std::string, std::string> files;
  zip_t* archive = zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr);
  EXPECT_NE(archive, nullptr) << path;
  if (archive == nullptr) return files;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    zip_stat_t status{};
    EXPECT_EQ(zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &status), 0);
    std::string bytes(status.size, '\0');
    zip_file_t* file = zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0);
    EXPECT_EQ(zip_fread(file, bytes.data(), bytes.size()), static_cast<zip_int64_t>(bytes.size()));
    zip_fclose(file);
    files.emplace(status.name, bytes);
  }
  zip_close(archive);
  return files;
}

inline pugi::xml_document parse(const std::string& text) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(text.c_str())) << text;
  return document;
}

inline std::vector<std::string> childrenOf(const pugi::xml_node& node) {
  std::vector<std::string> names;
  for (const pugi::xml_node& child : node.children()) names.emplace_back(child.name());
  return names;
}

using Names = std::vector<std::string>;

/// The lines of a report's table, without its head.
inline std::vector<std::string> tableOf(const fs::path& report) {
  std::istringstream text(readBytes(report / "clashes.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  lines.erase(lines.begin());
  return lines;
}

/// The cells of a line of a table in which nothing is quoted.
inline Names cellsOf(const std::string& line) {
  Names cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

/// The rows of a report's table, each by the names of its columns.
inline std::vector<std::map<std::string, std::string>> rowsOf(const fs::path& report) {
  std::string head = readBytes(report / "clashes.csv");
  head = head.substr(0, head.find('\n'));
  if (head.starts_with("\xEF\xBB\xBF")) head.erase(0, 3);
  const Names columns = cellsOf(head);
  std::vector<std::map<std::string, std::string>> rows;
  for (const std::string& line : tableOf(report)) {
    const Names cells = cellsOf(line);
    EXPECT_EQ(cells.size(), columns.size()) << line;
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < columns.size() && i < cells.size(); ++i) row[columns[i]] = cells[i];
  }
  return rows;
}

}  // namespace allpairs::test
