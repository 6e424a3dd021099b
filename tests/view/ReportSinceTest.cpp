// SPDX-License-Identifier: MIT
// Reports that are compared with earlier ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "ReportFiles.h"
#include "app/Expect.h"
#include "support/IfcText.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// GUIDs of a report by the names of their two models, in order.
std::map<std::string, std::string> guidsByNames(const fs::path& report) {
  std::map<std::string, std::string> guids;
  for (const auto& row : rowsOf(report)) {
    const auto& [first, second] = std::minmax(row.at("first"), row.at("second"));
    guids[first + ' ' + second] = row.at("guid");
  }
  return guids;
}

TEST(ReportSince, GuidsStayWhenTheFolderMovesAndOtherPartsCome) {
  const TempFolder folder;
  for (const char* name : {"b", "c"})
    folder.write("here/" + std::string(name) + ".obj", "o " + std::string(name) + '\n' + kTriangle);
  expectSuccess(runProgram({"report", folder.path() / "here", "--boxes", "-o", folder.path() / "one"}));
  fs::create_directory(folder.path() / "there");
  fs::rename(folder.path() / "here", folder.path() / "there/new");
  folder.write("there/new/a.obj", "o b\n" + kTriangle);  // now b is no name of one part alone
  expectSuccess(runProgram({"report", folder.path() / "there/new", "--boxes", "-o", folder.path() / "two"}));
  const auto one = guidsByNames(folder.path() / "one");
  const auto two = guidsByNames(folder.path() / "two");
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(two.size(), 3U);
  EXPECT_EQ(one.at("b c"), two.at("b.obj › b c"));
}

TEST(ReportSince, MarksWhatIsNewPersistsAndIsResolved) {
  const TempFolder folder;
  const auto part = [&](const std::string& name, const std::string& text) {
    folder.write("parts/" + name + ".obj", "o " + name + '\n' + text);
  };
  const std::string away = "v 9 9 9\nv 10 9 9\nv 9 10 10\nf -3 -2 -1\n";
  part("a", kTriangle);
  part("=b", kTriangle);
  part("c", away);
  const fs::path out = folder.path() / "out";
  const std::string parts = folder.path() / "parts";
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", out}));
  part("c", kTriangle);  // c comes in, and =b goes
  part("=b", away);
  part("d", away);
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", out, "--since", out}));
  std::map<std::string, std::string> states;
  for (const auto& row : rowsOf(out)) {
    const std::string& number = row.at("number");
    states[row.at("first") + ' ' + row.at("second")] = row.at("since") + ' ' + (number.empty() ? "-" : number);
  }
  // Before: a with =b. Now: a with c, and d with =b.
  EXPECT_EQ(states,
            (std::map<std::string, std::string>{{"c a", "new 1"}, {"d '=b", "new 2"}, {"a '=b", "resolved -"}}));
  EXPECT_NE(readBytes(out / "index.html").find(": 2 new, 0 persisting, 1 resolved.</p>"), std::string::npos);
  Names topics;
  for (const auto& [name, bytes] : filesOf(out / "clashes.bcf")) {
    if (!name.ends_with("markup.bcf")) continue;
    const pugi::xml_document document = parse(bytes);
    const pugi::xml_node topic = document.child("Markup").child("Topic");
    topics.push_back(std::string(topic.child_value("Title")) + ' ' + topic.child_value("Labels") + ' ' +
                     topic.attribute("TopicStatus").value());
  }
  std::sort(topics.begin(), topics.end());
  EXPECT_EQ(topics, (Names{"a and =b resolved Closed", "c and a new Open", "d and =b new Open"}));
  // The same again: nothing is new, and what was resolved before is not resolved again.
  expectSuccess(
      runProgram({"report", parts, "--boxes", "-o", folder.path() / "again", "--since", out / "clashes.csv"}));
  const std::string nothingNew = ": 0 new, 2 persisting, 0 resolved.</p>";
  EXPECT_NE(readBytes(folder.path() / "again/index.html").find(nothingNew), std::string::npos);
  // A spreadsheet ends lines in another way.
  const std::string table = std::regex_replace(readBytes(out / "clashes.csv"), std::regex("\n"), "\r\n");
  const std::string saved = folder.write("saved.csv", table);
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", folder.path() / "again", "--since", saved}));
  EXPECT_NE(readBytes(folder.path() / "again/index.html").find(nothingNew), std::string::npos);
}

TEST(ReportSince, TopicsOfWhatIsResolvedHaveTheHeaderOfTheirVersion) {
  const TempFolder folder;
  const std::string parts = folder.path() / "parts";
  folder.write("parts/a.obj", "o a\n" + kTriangle);
  folder.write("parts/b.obj", "o '=b\n" + kTriangle);
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", folder.path() / "before"}));
  folder.write("parts/b.obj", "o '=b\nv 9 9 9\nv 10 9 9\nv 9 10 10\nf -3 -2 -1\n");
  for (const std::string version : {"2.1", "3.0"}) {
    const fs::path out = folder.path() / version;
    expectSuccess(
        runProgram({"report", parts, "--boxes", "--bcf", version, "-o", out, "--since", folder.path() / "before"}));
    std::size_t count = 0;
    for (const auto& [name, bytes] : filesOf(out / "clashes.bcf")) {
      if (!name.ends_with("markup.bcf")) continue;
      const pugi::xml_document document = parse(bytes);
      EXPECT_STREQ(document.child("Markup").child("Topic").attribute("TopicStatus").value(), "Closed");
      EXPECT_STREQ(document.child("Markup").child("Topic").child_value("Title"), "'=b and a");
      const pugi::xml_node header = document.child("Markup").child("Header");
      const bool isThree = version == "3.0";
      const pugi::xml_node file = isThree ? header.child("Files").child("File") : header.child("File");
      EXPECT_STREQ(file.attribute(isThree ? "IsExternal" : "isExternal").value(), "true") << version;
      ++count;
    }
    EXPECT_EQ(count, 1U) << version;
  }
}

TEST(ReportSince, ComparesWhatWasAClashAndHowDeepItWas) {
  const TempFolder folder;
  const auto write = [&](double lid, double d, double f) {
    std::string text;
    const auto add = [&text](const std::string& name, double x) {
      text += name + ',' + std::to_string(x) + ",0,0," + std::to_string(x + 1.0) + ",1,1\n";
    };
    const std::vector<std::pair<std::string, double>> boxes{{"a", 0.0},  {"lid", lid}, {"c", 10.0}, {"d", d},
                                                            {"e", 20.0}, {"f", f},     {"g", 30.0}, {"h", 30.75}};
    for (const auto& [name, x] : boxes) add(name, x);
    return folder.write("boxes.csv", text);
  };
  const fs::path out = folder.path() / "out";
  expectSuccess(runProgram({"report", write(1.0, 10.75, 20.75), "--exact", "-o", out}));
  expectSuccess(runProgram({"report", write(0.5, 11.0, 20.5), "--exact", "-o", out, "--since", out}));
  std::map<std::string, std::string> changes;
  for (const auto& row : rowsOf(out))
    changes[row.at("first") + ' ' + row.at("second")] = row.at("state") + ' ' + row.at("since");
  EXPECT_EQ(changes, (std::map<std::string, std::string>{{"lid a", "clash new"},
                                                         {"d c", "touching resolved"},
                                                         {"f e", "clash persisting"},
                                                         {"h g", "clash persisting"}}));
  const auto statusOf = [&](const std::string& what, const fs::path& earlier) {
    const ProgramRun run = runProgram({"report", folder.path() / "boxes.csv", "--exact", "-o", folder.path() / "again",
                                       "--since", earlier, "--fail-on", what});
    return std::to_string(run.status) + run.err.substr(0, run.err.find('\n'));
  };
  EXPECT_EQ(statusOf("new", out), "0");  // out is what is there now
  EXPECT_EQ(statusOf("clash", out), "4allpairs: --fail-on: found 3 rows of clashes");
  EXPECT_EQ(statusOf("pair", out), "4allpairs: --fail-on: found 4 rows");
  const auto statusOfOne = [&](const std::string& what, const fs::path& earlier) {
    const std::string boxes = folder.write("one.csv", "p,0,0,0,2,1,1\nq,1,0,0,2,1,1\n");
    return runProgram({"report", boxes, "--exact", "-o", folder.path() / "one", "--since", earlier, "--fail-on", what})
        .err;
  };
  EXPECT_EQ(statusOfOne("new", out), "allpairs: --fail-on: found 1 new row\n");
  EXPECT_EQ(statusOfOne("clash", out), "allpairs: --fail-on: found 1 row of clashes\n");
  EXPECT_EQ(statusOfOne("pair", out), "allpairs: --fail-on: found 1 row\n");
  expectFailure(runProgram({"report", folder.path(), "-o", out, "--fail-on", "new"}), 2, "add --since");
  // A report of boxes had no clashes, and one of unknown states may have had none.
  const fs::path ofBoxes = folder.path() / "boxes";
  expectSuccess(runProgram({"report", folder.path() / "boxes.csv", "--boxes", "-o", ofBoxes}));
  EXPECT_EQ(statusOf("new", ofBoxes), "4allpairs: --fail-on: found 3 new rows");
  const std::string page = readBytes(out / "index.html");
  EXPECT_NE(page.find(": 1 new, 2 persisting, 1 resolved.</p>"), std::string::npos);
  std::map<std::string, std::string> topics;
  for (const auto& [name, bytes] : filesOf(out / "clashes.bcf")) {
    if (!name.ends_with("markup.bcf")) continue;
    const pugi::xml_document document = parse(bytes);
    const pugi::xml_node topic = document.child("Markup").child("Topic");
    const std::string words = topic.child_value("Description");
    const std::string status = topic.attribute("TopicStatus").value();
    EXPECT_NE(page.find("data-guid=\"" + name.substr(0, name.find('/')) + "\" data-status=\"" + status + '"'),
              std::string::npos)
        << name;
    const std::size_t before = words.find(" Before: ");
    topics[topic.child_value("Title")] = std::string(topic.attribute("TopicType").value()) + ' ' + status +
                                         (before == std::string::npos ? "" : words.substr(before));
    if (before != std::string::npos) {
      EXPECT_NE(page.find(words.substr(before)), std::string::npos) << words;
    }
  }
  EXPECT_EQ(topics, (std::map<std::string, std::string>{{"lid and a", "Clash Open Before: touching."},
                                                        {"d and c", "Contact Closed Before: clash, 0.25 deep."},
                                                        {"f and e", "Clash Open Before: clash, 0.25 deep."},
                                                        {"h and g", "Clash Open"}}));
}

TEST(ReportSince, FilesOfOneNameAreKnownByTheirFolders) {
  const TempFolder folder;
  for (const char* name : {"left/bolt.obj", "right/bolt.obj", "base/plate.obj"}) {
    folder.write(name, kTriangle);
  }
  // The GUID of each pair, which is known by the one that it is without.
  const auto guids = [&](const Names& folders, const char* out) {
    Names words{"report", "--boxes", "-o", folder.path() / out};
    for (const std::string& name : folders) words.push_back(folder.path() / name);
    expectSuccess(runProgram(words));
    std::map<std::string, std::string> found;
    for (const auto& [names, guid] : guidsByNames(folder.path() / out)) {
      for (const char* name : {"left", "right", "plate"}) {
        if (names.find(name) == std::string::npos) found[name] = guid;
      }
    }
    return found;
  };
  const std::map<std::string, std::string> before = guids({"left", "right", "base"}, "before");
  ASSERT_EQ(before.size(), 3U);
  EXPECT_EQ(guids({"right", "base", "left"}, "turned"), before) << "whatever their order";
  // Where there is one of the name it may be either: what is found is new.
  const std::map<std::string, std::string> after = guids({"right", "base"}, "after");
  ASSERT_EQ(after.size(), 2U) << "without one of the name, and so without its folder";
  for (const auto& [name, guid] : before) EXPECT_NE(after.at("left"), guid) << name;
}

/// The rows of a report of parts of three triangles, with one before it; each is a file, at a place on the x axis.
class MovedFiles {
 public:
  using Parts = std::map<std::string, double>;
  /// What became of each row of now, by its names, and its GUID.
  using Rows = std::map<std::string, std::pair<std::string, std::string>>;

  Rows report(const Parts& parts, const Names& options = {}) {
    std::map<std::string, std::string> texts;
    for (const auto& [name, x] : parts) texts[name] = "o part\n" + wedgeAt(x);
    return reportFiles(texts, options);
  }
  Rows reportSince(const Parts& parts, const Names& options = {}) { return report(parts, since(options)); }

  /// Of files with these texts.
  Rows reportFiles(const std::map<std::string, std::string>& texts, const Names& options) {
    fs::remove_all(m_folder.path() / "parts");
    for (const auto& [name, text] : texts) m_folder.write("parts/" + name, text);
    Names words{"report", m_folder.path() / "parts", "--recursive", "-o", m_folder.path() / "out"};
    words.insert(words.end(), options.begin(), options.end());
    expectSuccess(runProgram(words));
    Rows rows;
    for (const auto& row : rowsOf(m_folder.path() / "out")) {
      const auto& [first, second] = std::minmax(row.at("first_file"), row.at("second_file"));
      const auto since = row.find("since");
      rows[first + ' ' + second] = {since == row.end() ? "" : since->second, row.at("guid")};
    }
    return rows;
  }
  /// Options, with the one before.
  [[nodiscard]] Names since(const Names& options) const {
    Names words{"--since", m_folder.path() / "out"};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

 private:
  static std::string wedgeAt(double x) {
    std::string text;
    for (const auto& [dx, y, z] : {std::array{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}})
      text += "v " + std::to_string(x + dx) + ' ' + std::to_string(y) + ' ' + std::to_string(z) + '\n';
    return text + "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
  }

  TempFolder m_folder;
};

TEST(ReportSince, ClashesStayWhereAFileOfTheSameNameComesIntoAnotherFolderOrGoes) {
  MovedFiles files;
  const MovedFiles::Parts one{{"left/bolt.obj", 0.0}, {"left/plate.obj", 0.25}};
  const std::string guid = files.report(one).at("bolt.obj plate.obj").second;
  MovedFiles::Parts two = one;
  two["right/bolt.obj"] = 50.0;
  two["before/plate.obj"] = 60.0;
  const MovedFiles::Rows persists{{"left/bolt.obj left/plate.obj", {"persisting", guid}}};
  EXPECT_EQ(files.reportSince(two), persists);
  EXPECT_EQ(files.reportSince(two), persists);
  EXPECT_EQ(files.reportSince(one), (MovedFiles::Rows{{"bolt.obj plate.obj", {"persisting", guid}}}));
}

TEST(ReportSince, OfClashesWithFilesOfOneNameTheOneAtTheSamePointStays) {
  MovedFiles files;
  const MovedFiles::Rows before = files.report({{"left/bolt.obj", 0.0}, {"right/bolt.obj", 0.75}, {"plate.obj", 0.25}});
  ASSERT_EQ(before.size(), 3U);
  const std::string& right = before.at("plate.obj right/bolt.obj").second;
  EXPECT_EQ(files.reportSince({{"right/bolt.obj", 0.75}, {"plate.obj", 0.25}}),
            (MovedFiles::Rows{
                {"bolt.obj plate.obj", {"persisting", right}},
                {"left/bolt.obj plate.obj", {"resolved", before.at("left/bolt.obj plate.obj").second}},
                {"left/bolt.obj right/bolt.obj", {"resolved", before.at("left/bolt.obj right/bolt.obj").second}}}));
}

TEST(ReportSince, AClashWithAnotherFileOfTheNameIsAnother) {
  MovedFiles files;
  const std::string guid = files.report({{"left/bolt.obj", 0.0}, {"plate.obj", 0.25}}).at("bolt.obj plate.obj").second;
  // At another point: the bolt on the left is gone from where it was.
  MovedFiles::Rows after = files.reportSince({{"left/bolt.obj", 9.0}, {"right/bolt.obj", 0.5}, {"plate.obj", 0.25}});
  EXPECT_EQ(after.at("plate.obj right/bolt.obj").first, "new");
  EXPECT_EQ(after.at("bolt.obj plate.obj"), std::pair(std::string("resolved"), guid));
  // At the same point, in the place of the other.
  const std::string right = after.at("plate.obj right/bolt.obj").second;
  after = files.reportSince({{"left/bolt.obj", 0.5}, {"right/bolt.obj", 9.0}, {"plate.obj", 0.25}});
  EXPECT_EQ(after.at("left/bolt.obj plate.obj").first, "new");
  EXPECT_EQ(after.at("plate.obj right/bolt.obj"), std::pair(std::string("resolved"), right));
  // Two at one point: it may be either.
  files.report({{"left/bolt.obj", 0.0}, {"plate.obj", 0.25}});
  after = files.reportSince({{"left/bolt.obj", 0.0}, {"right/bolt.obj", 0.0}, {"plate.obj", 0.25}});
  EXPECT_EQ(after.at("left/bolt.obj plate.obj").first, "new");
  EXPECT_EQ(after.at("plate.obj right/bolt.obj").first, "new");
  EXPECT_EQ(after.at("bolt.obj plate.obj"), std::pair(std::string("resolved"), guid));
}

TEST(ReportSince, AFilesOwnClashIsKnownByTheFileAndNotByGlobalIdsInIt) {
  MovedFiles files;
  const Names byFile{"--group", "file"};
  const std::string others = std::regex_replace(kIfc, std::regex("ctVUKr0kugbFTf53O9L"), "ctVUKr0kugbFTf53O9M");
  const std::string far =
      std::regex_replace(others, std::regex("#8=IFCCARTESIANPOINT..0"), "#8=IFCCARTESIANPOINT((100000");
  ASSERT_NE(far, others);
  const std::string left = files.reportFiles({{"left/m.ifc", kIfc}}, byFile).at("m.ifc m.ifc").second;
  const MovedFiles::Rows both = files.reportFiles({{"left/m.ifc", kIfc}, {"right/m.ifc", far}}, files.since(byFile));
  EXPECT_EQ(both.at("left/m.ifc left/m.ifc"), std::pair(std::string("persisting"), left));
  const std::string& right = both.at("right/m.ifc right/m.ifc").second;
  EXPECT_NE(right, left);
  EXPECT_EQ(files.reportFiles({{"right/m.ifc", far}}, files.since(byFile)),
            (MovedFiles::Rows{{"m.ifc m.ifc", {"persisting", right}}, {"left/m.ifc left/m.ifc", {"resolved", left}}}));
}

TEST(ReportSince, ANewClashHasNotTheGuidThatAnotherKept) {
  MovedFiles files;
  const MovedFiles::Parts one{{"left/bolt.obj", 0.0}, {"plate.obj", 0.25}};
  const std::string guid = files.report(one).at("bolt.obj plate.obj").second;
  MovedFiles::Parts two = one;
  two["right/bolt.obj"] = 9.0;
  EXPECT_EQ(files.reportSince(two), (MovedFiles::Rows{{"left/bolt.obj plate.obj", {"persisting", guid}}}));
  // Now the file on the right is known as that on the left was at first.
  const MovedFiles::Parts right{{"right/bolt.obj", 0.5}, {"plate.obj", 0.25}};
  MovedFiles::Rows after = files.reportSince(right);
  const std::string another = after.at("bolt.obj plate.obj").second;
  EXPECT_NE(another, guid);
  EXPECT_EQ(after, (MovedFiles::Rows{{"bolt.obj plate.obj", {"new", another}},
                                     {"left/bolt.obj plate.obj", {"resolved", guid}}}));
  EXPECT_EQ(files.reportSince(right), (MovedFiles::Rows{{"bolt.obj plate.obj", {"persisting", another}}}));
}

TEST(ReportSince, NamesThatAreNotUtf8AreKnownAgain) {
  const TempFolder folder;
  folder.write("parts/a.obj", "o tr\xe4ger\n" + kTriangle);
  folder.write("parts/b.obj", "o st\xfctze\n" + kTriangle);
  const std::string parts = folder.path() / "parts";
  const fs::path out = folder.path() / "out";
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", out}));
  const std::string guid = rowsOf(out).at(0).at("guid");
  fs::rename(folder.path() / "parts/a.obj", folder.path() / "parts/c.obj");
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", out, "--since", out}));
  const auto rows = rowsOf(out);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("since"), "persisting");
  EXPECT_EQ(rows[0].at("guid"), guid);
}

TEST(ReportSince, SaysWhatIsNoReport) {
  const TempFolder folder;
  const std::string out = folder.path() / "out";
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", folder.path()}), 3,
                "holds no report to compare with");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", ""}), 2, "--since: the value is empty");
  fs::create_directories(folder.path() / "odd/clashes.csv");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", folder.path() / "odd"}), 3,
                "odd/clashes.csv: is a folder, not a file");
  if (::geteuid() != 0) {
    const std::string locked = folder.write("locked.csv", "");
    fs::permissions(locked, fs::perms::none);
    expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", locked}), 3,
                  "locked.csv: cannot be opened: Permission denied");
  }
  const std::string table = folder.write("other.csv", "a,b\n1,2\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", table}), 3,
                "other.csv: is no table of a report");
  for (const char* head : {"nr,first,second,guid", "number,one,second,guid", "number,first,two,guid",
                           "number,first,second,id", "number,first,second"})
    expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", folder.write("near.csv", head)}), 3,
                  "near.csv: is no table of a report");
  const std::string hostile =
      folder.write("hostile.csv", "number,first,second,guid\n1,a,b,../../../../../../../../../../../../\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", hostile}), 3, "a line has other columns");
  const std::string cut = folder.write("cut.csv", "number,first,second,guid\n1,a\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", cut}), 3, "a line has other columns (row 2)\n");
  const std::string semicolons = folder.write("semicolons.csv", "\xEF\xBB\xBFnumber;first;second;guid\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", semicolons}), 3,
                "its first line is another; semicolons separate its columns, not commas\n");
  const std::string tabs = folder.write("tabs.csv", "number\tfirst\tsecond\tguid\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", tabs}), 3, "; tabs separate its columns");
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace allpairs::test
