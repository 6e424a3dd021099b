// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "ReportFiles.h"
#include "app/Expect.h"
#include "support/IfcText.h"
#include "support/Npy.h"
#include "support/Numbers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

const std::string kDemo = ALLPAIRS_SOURCE_DIR "/examples/scenes/demo.scn";

bool isGuid(const std::string& text) {
  static const std::regex kForm("[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}");
  return std::regex_match(text, kForm);
}

/// The order and the names of BCF 2.1's markup.xsd.
void expectMarkup(const std::string& text, const std::string& folder) {
  const pugi::xml_document document = parse(text);
  const pugi::xml_node markup = document.child("Markup");
  EXPECT_EQ(childrenOf(markup), (Names{"Header", "Topic", "Viewpoints"}));
  const pugi::xml_node topic = markup.child("Topic");
  EXPECT_EQ(topic.attribute("Guid").value(), folder);
  EXPECT_EQ(childrenOf(markup.child("Header")), (Names{"File"}));
  EXPECT_EQ(childrenOf(markup.child("Header").child("File")), (Names{"Filename"}));
  EXPECT_EQ(childrenOf(topic), (Names{"Title", "Index", "CreationDate", "CreationAuthor", "Description"}));
  EXPECT_TRUE(std::regex_match(topic.child_value("CreationDate"),
                               std::regex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z")));
  const pugi::xml_node viewpoints = markup.child("Viewpoints");
  EXPECT_EQ(childrenOf(viewpoints), (Names{"Viewpoint", "Snapshot", "Index"}));
  EXPECT_TRUE(isGuid(viewpoints.attribute("Guid").value()));
  EXPECT_STREQ(viewpoints.child_value("Viewpoint"), "viewpoint.bcfv");
  EXPECT_STREQ(viewpoints.child_value("Snapshot"), "snapshot.png");
}

/// The order and the names of BCF 2.1's visinfo.xsd.
void expectViewpoint(const std::string& text) {
  const pugi::xml_document document = parse(text);
  const pugi::xml_node info = document.child("VisualizationInfo");
  EXPECT_TRUE(isGuid(info.attribute("Guid").value()));
  EXPECT_EQ(childrenOf(info), (Names{"Components", "OrthogonalCamera"}));
  EXPECT_EQ(childrenOf(info.child("Components")), (Names{"Selection", "Visibility", "Coloring"}));
  for (const pugi::xml_node& component : info.child("Components").child("Selection").children()) {
    EXPECT_STREQ(component.name(), "Component");
    EXPECT_EQ(childrenOf(component), (Names{"OriginatingSystem", "AuthoringToolId"}));
  }
  EXPECT_FALSE(info.child("Components").child("Visibility").attribute("DefaultVisibility").empty());
  const pugi::xml_node camera = info.child("OrthogonalCamera");
  EXPECT_EQ(childrenOf(camera), (Names{"CameraViewPoint", "CameraDirection", "CameraUpVector", "ViewToWorldScale"}));
  for (const char* part : {"CameraViewPoint", "CameraDirection", "CameraUpVector"}) {
    EXPECT_EQ(childrenOf(camera.child(part)), (Names{"X", "Y", "Z"}));
    for (const pugi::xml_node& coordinate : camera.child(part).children()) {
      EXPECT_TRUE(std::isfinite(coordinate.text().as_double(kNan))) << part;
    }
  }
  EXPECT_GT(camera.child("ViewToWorldScale").text().as_double(), 0.0);
}

TEST(Report, BcfHasATopicAViewpointAndAPictureForEachPairInTheFormOfVersion21) {
  const TempFolder folder;
  expectSuccess(runProgram({"report", kDemo, "--boxes", "--group", "none", "-o", folder.path() / "out"}));
  const auto files = filesOf(folder.path() / "out/clashes.bcf");
  const pugi::xml_document version = parse(files.at("bcf.version"));
  EXPECT_STREQ(version.child("Version").attribute("VersionId").value(), "2.1");
  EXPECT_EQ(childrenOf(version.child("Version")), (Names{"DetailedVersion"}));
  std::size_t topics = 0;
  for (const auto& [name, bytes] : files) {
    if (!name.ends_with("/markup.bcf")) continue;
    const std::string guid = name.substr(0, name.find('/'));
    EXPECT_TRUE(isGuid(guid)) << guid;
    expectMarkup(bytes, guid);
    expectViewpoint(files.at(guid + "/viewpoint.bcfv"));
    EXPECT_EQ(files.at(guid + "/snapshot.png").substr(0, 4), "\x89PNG");
    ++topics;
  }
  const auto result = nlohmann::json::parse(runProgram({"detect", kDemo, "--format", "json"}).out);
  EXPECT_EQ(topics, result["pairs"].size());
  EXPECT_EQ(files.size(), 3 * topics + 1);
}

TEST(Report, NamesAreNoFormulasInTheTableAndSaidToBeUtf8) {
  const TempFolder folder;
  const std::string input = folder.write("names.csv", "=1+1,0,0,0,2,2,2\n@x,1,1,1,3,3,3\n-y,1,1,1,3,3,2\n");
  expectSuccess(runProgram({"report", input, "-o", folder.path() / "out", "--pictures", "0"}));
  const std::string table = readBytes(folder.path() / "out/clashes.csv");
  EXPECT_TRUE(table.starts_with("number,first,second,"));
  for (const char* cells : {"\n1,'-y,'@x,2,2,1,4,", ",'@x,'=1+1,1,1,1,1,", ",'-y,'=1+1,1,1,1,1,"}) {
    EXPECT_NE(table.find(cells), std::string::npos) << cells << " in " << table;
  }
  const std::string umlaut = folder.write("umlaut.csv", "\xC3\xA4,0,0,0,2,2,2\nb,1,1,1,3,3,3\n");
  expectSuccess(runProgram({"report", umlaut, "-o", folder.path() / "out", "--pictures", "0"}));
  EXPECT_TRUE(readBytes(folder.path() / "out/clashes.csv")
                  .starts_with("\xEF\xBB\xBFnumber,first,second,overlap_x,overlap_y,overlap_z,volume,guid\n"
                               "1,b,\xC3\xA4,1,1,1,1,"));
  const std::string broken = folder.write("broken.csv", "a\xFF,0,0,0,2,2,2\nb,1,1,1,3,3,3\n");
  expectSuccess(runProgram({"report", broken, "-o", folder.path() / "out", "--pictures", "0"}));
  EXPECT_NE(readBytes(folder.path() / "out/clashes.csv").find("\n1,b,a\xEF\xBF\xBD,1,1,1,1,"), std::string::npos);
}

TEST(Report, TableHasEveryPairOfDetectOnce) {
  const TempFolder folder;
  expectSuccess(runProgram({"report", kDemo, "--boxes", "-o", folder.path() / "out", "--pictures", "2"}));
  const std::string table = readBytes(folder.path() / "out/clashes.csv");
  std::vector<std::string> found;
  std::size_t begin = table.find('\n') + 1;
  for (std::size_t end = table.find('\n', begin); end != std::string::npos; end = table.find('\n', begin)) {
    const std::string line = table.substr(begin, end - begin);
    const std::size_t first = line.find(',') + 1;
    found.push_back(line.substr(first, line.find(',', line.find(',', first) + 1) - first));
    begin = end + 1;
  }
  std::vector<std::string> expected;
  const auto result = nlohmann::json::parse(runProgram({"detect", kDemo, "--format", "json"}).out);
  for (const auto& pair : result["pairs"]) {
    expected.push_back(result["models"][pair[0].get<std::size_t>()]["name"].get<std::string>() + ',' +
                       result["models"][pair[1].get<std::size_t>()]["name"].get<std::string>());
  }
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(fs::exists(folder.path() / "out/pictures/0002.png"));
  EXPECT_FALSE(fs::exists(folder.path() / "out/pictures/0003.png"));
  EXPECT_NE(readBytes(folder.path() / "out/index.html").find("The first 2 have pictures"), std::string::npos);
}

TEST(Report, NamesAreTextInThePageAndInBcf) {
  const TempFolder folder;
  const std::string name = "<img src=x onerror=alert(1)>";
  folder.write("a.obj", "o " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("b.obj", "o b & c\nv 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  expectSuccess(runProgram({"report", folder.path(), "--boxes", "-o", folder.path() / "out"}));
  const std::string page = readBytes(folder.path() / "out/index.html");
  EXPECT_EQ(page.find("<img src=x"), std::string::npos);
  EXPECT_NE(page.find("&lt;img src=x onerror=alert(1)&gt;"), std::string::npos);
  std::size_t topics = 0;
  for (const auto& [file, bytes] : filesOf(folder.path() / "out/clashes.bcf")) {
    if (!file.ends_with("markup.bcf")) continue;
    const std::string title = parse(bytes).child("Markup").child("Topic").child_value("Title");
    EXPECT_EQ(title, "b & c and " + name);
    ++topics;
  }
  EXPECT_EQ(topics, 1U);
}

TEST(Report, ControlCharactersInANameAreReplacedInBcf) {
  const TempFolder folder;
  const std::string input =
      folder.write("names.csv", "a\x01\tb,0,0,0,2,2,2\nc\xff\xEF\xBF\xBE\xEF\xBF\xBF,1,1,1,3,3,3\n");
  expectSuccess(runProgram({"report", input, "-o", folder.path() / "out"}));
  std::size_t topics = 0;
  for (const auto& [file, bytes] : filesOf(folder.path() / "out/clashes.bcf")) {
    if (!file.ends_with("markup.bcf")) continue;
    const std::string title = parse(bytes).child("Markup").child("Topic").child_value("Title");
    EXPECT_EQ(title, "c\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD and a\xEF\xBF\xBD b");
    ++topics;
  }
  EXPECT_EQ(topics, 1U);
}

/// Three numbers below an element.
std::array<double, 3> vectorOf(const pugi::xml_node& element) {
  return {element.child("X").text().as_double(), element.child("Y").text().as_double(),
          element.child("Z").text().as_double()};
}

TEST(Report, TheCameraOfAnIfcLooksAtTheContactInMetresAndStandsUpright) {
  const TempFolder folder;
  const std::string input = folder.write("two.ifc", kIfc);
  const auto cameraOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"report", input, "-o", folder.path() / "out"};
    words.insert(words.end(), more.begin(), more.end());
    expectSuccess(runProgram(words));
    for (const auto& [file, bytes] : filesOf(folder.path() / "out/clashes.bcf")) {
      if (file.ends_with("viewpoint.bcfv")) return parse(bytes);
    }
    return pugi::xml_document();
  };
  for (const bool isBoxes : {false, true}) {
    const pugi::xml_document document = cameraOf(isBoxes ? Names{"--boxes"} : Names{});
    const pugi::xml_node camera = document.child("VisualizationInfo").child("OrthogonalCamera");
    const auto eye = vectorOf(camera.child("CameraViewPoint"));
    const auto direction = vectorOf(camera.child("CameraDirection"));
    EXPECT_GT(vectorOf(camera.child("CameraUpVector"))[2], 0.4) << "z is up";
    const double scale = camera.child("ViewToWorldScale").text().as_double();
    EXPECT_LT(scale, 10.0) << "metres";
    // What it looks at, twice its height ahead, lies in the two models.
    EXPECT_NEAR(eye[0] + 2.0 * scale * direction[0], 3.0, 2.0);
    EXPECT_NEAR(eye[1] + 2.0 * scale * direction[1], 0.5, 0.5);
    EXPECT_NEAR(eye[2] + 2.0 * scale * direction[2], 2.5, 2.5);
  }
  const pugi::xml_document turned = cameraOf({"--up", "y"});
  const pugi::xml_node camera = turned.child("VisualizationInfo").child("OrthogonalCamera");
  EXPECT_GT(vectorOf(camera.child("CameraUpVector"))[1], 0.4);
}

std::vector<std::string> filesIn(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    files.push_back(entry.path().lexically_relative(folder));
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Report, WithoutPairsSaysSo) {
  const TempFolder folder;
  const std::string input = folder.write("a.csv", "0,0,0,1,1,1\n5,5,5,6,6,6\n");
  expectSuccess(runProgram({"report", input, "-o", folder.path() / "out"}));
  const std::string page = readBytes(folder.path() / "out/index.html");
  EXPECT_NE(page.find("No pair was found"), std::string::npos);
  EXPECT_EQ(page.find("<table"), std::string::npos);
  EXPECT_EQ(readBytes(folder.path() / "out/clashes.csv"),
            "number,first,second,overlap_x,overlap_y,overlap_z,volume,guid\n");
  EXPECT_EQ(filesOf(folder.path() / "out/clashes.bcf").size(), 1U);
}

/// The bytes that a text in base64 stands for (RFC 4648, section 4); none when it holds anything else.
std::string bytesOfBase64(std::string_view text) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  if (text.size() % 4 != 0) return {};
  text = text.substr(0, text.find_last_not_of('=') + 1);
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char digit : text) {
    const std::size_t value = kDigits.find(digit);
    if (value == std::string_view::npos) return {};
    bits = (bits << 6U | static_cast<unsigned>(value)) & 0xFFFFU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFFU);
  }
  return bytes;
}

TEST(Report, HandsItsBcfToThePageAsAScript) {
  const TempFolder folder;
  const std::string input = folder.write("a.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n");
  expectSuccess(runProgram({"report", input, "-o", folder.path() / "out"}));
  const std::string script = readBytes(folder.path() / "out/clashes.bcf.js");
  const std::string_view begin = "allpairsBcf(\"", end = "\");\n";
  ASSERT_TRUE(script.starts_with(begin) && script.ends_with(end));
  const std::string base64 = script.substr(begin.size(), script.size() - begin.size() - end.size());
  EXPECT_TRUE(bytesOfBase64(base64) == readBytes(folder.path() / "out/clashes.bcf"));
}

TEST(Report, SaysWhenItWasMadeByWhatAndHow) {
  const TempFolder folder;
  const std::string input = folder.write("a.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n");
  const auto factsOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"report", input, "-o", folder.path() / "out"};
    words.insert(words.end(), more.begin(), more.end());
    expectSuccess(runProgram(words));
    const std::string page = readBytes(folder.path() / "out/index.html");
    std::map<std::string, std::string> facts;
    const std::regex form("<div><dt>([^<]*)</dt><dd>([^<]*)</dd></div>");
    for (std::sregex_iterator fact(page.begin(), page.end(), form), end; fact != end; ++fact)
      facts.emplace((*fact)[1], (*fact)[2]);
    return facts;
  };
  auto facts = factsOf({"--distance", "0.25", "--metres-per-unit", "0.0254", "--up", "y"});
  EXPECT_TRUE(std::regex_match(facts["Made"], std::regex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z")));
  EXPECT_EQ(facts["By"], "allpairs " ALLPAIRS_VERSION);
  EXPECT_EQ(facts["Distance"], "0.25");
  EXPECT_EQ(facts["Tested"], "boxes");
  EXPECT_EQ(facts["Lengths"], "inches, as --metres-per-unit says");
  EXPECT_EQ(facts["Up"], "y");
  facts = factsOf({});
  EXPECT_EQ(facts.count("Distance"), 0U);
  EXPECT_EQ(facts["Lengths"], "those of the input, which does not say how long they are");
  const std::string ifc = folder.write("two.ifc", kIfc);
  expectSuccess(runProgram({"report", ifc, "-o", folder.path() / "ifc"}));
  EXPECT_NE(readBytes(folder.path() / "ifc/index.html").find("<dd>millimetres, as the input says</dd>"),
            std::string::npos);
}

/// When the first file of an archive was made, as its bytes say it: the time and the day, in two bytes each.
std::array<unsigned, 2> momentOfZip(const std::string& bytes) {
  constexpr std::size_t kTime = 10, kDay = 12;
  const auto number = [&bytes](std::size_t at) {
    return static_cast<unsigned char>(bytes.at(at)) + 256U * static_cast<unsigned char>(bytes.at(at + 1));
  };
  return {number(kTime), number(kDay)};
}

TEST(Report, FilesInItsBcfAreAsOldAsTheReportSaysThatItIs) {
  const TempFolder folder;
  const std::string input = folder.write("a.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n");
  const std::string out = folder.path() / "out";
  const auto momentAt = [&](const std::string& seconds) {
    expectSuccess(runScript("SOURCE_DATE_EPOCH=" + seconds + " \"$0\" report '" + input + "' -o '" + out + "'"));
    return momentOfZip(readBytes(out + "/clashes.bcf"));
  };
  const std::array first{22U << 11 | 13U << 5 | 21U / 2, 43U << 9 | 11U << 5 | 14U};
  EXPECT_EQ(momentAt("1700000001"), first);  // 2023-11-14T22:13:21Z
  const std::array oldest{0U, 1U << 5 | 1U};
  EXPECT_EQ(momentAt("86400"), oldest);  // an archive knows no year before 1980
  const std::array latest{0U, 127U << 9 | 1U << 5 | 1U};
  EXPECT_EQ(momentAt("4354819200"), latest);  // 2108-01-01: nor one after 2107
}

TEST(Report, AShorterOneTakesThePicturesOfALongerOneAwayAndNothingElse) {
  const TempFolder folder;
  const std::string out = folder.path() / "out";
  const std::string three = folder.write("a.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n0,0,0,2,2,1\n");
  expectSuccess(runProgram({"report", three, "-o", out}));
  folder.write("out/pictures/mine.png", "");
  folder.write("out/pictures/0009.png", "");
  const std::string two = folder.write("b.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n");
  expectSuccess(runProgram({"report", two, "-o", out}));
  EXPECT_EQ(filesIn(out), (Names{"clashes.bcf", "clashes.bcf.js", "clashes.csv", "index.html", "pictures",
                                 "pictures/0001.png", "pictures/0009.png", "pictures/mine.png", "view.html"}));
}

TEST(Report, ThatCannotBeWrittenLeavesAnEarlierOneWhole) {
  const TempFolder folder;
  const fs::path out = folder.path() / "out";
  expectSuccess(runProgram({"report", folder.write("a.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n"), "-o", out}));
  fs::remove(out / "view.html");
  fs::create_directories(out / "view.html");  // no file can be put there
  const auto bytesIn = [](const fs::path& in) {
    std::map<std::string, std::string> files;
    for (const std::string& name : filesIn(in)) files[name] = fs::is_directory(in / name) ? "" : readBytes(in / name);
    return files;
  };
  const auto before = bytesIn(out);
  const std::string other = folder.write("b.csv", "0,0,0,9,9,9\n1,1,1,3,3,3\n4,4,4,5,5,5\n");
  expectFailure(runProgram({"report", other, "-o", out}), 3, "view.html");
  EXPECT_TRUE(bytesIn(out) == before);
}

TEST(Report, ThatCannotBeWrittenLeavesNothingBehind) {
  const TempFolder folder;
  fs::create_directories(folder.path() / "out/index.html/x");  // no file can be put there
  const ProgramRun run = runProgram({"report", kDemo, "-o", folder.path() / "out", "--pictures", "3", "--force"});
  expectFailure(run, 3, "index.html");
  EXPECT_EQ(filesIn(folder.path()), (Names{"out", "out/index.html", "out/index.html/x"}));
  expectFailure(runProgram({"report", "missing.obj", "-o", folder.path() / "a/b"}), 3, "missing.obj");
  EXPECT_FALSE(fs::exists(folder.path() / "a"));
  expectSuccess(runProgram({"report", kDemo, "-o", folder.path() / "a/b/", "--pictures", "1"}));
  EXPECT_TRUE(fs::exists(folder.path() / "a/b/pictures/0001.png"));
}

TEST(Report, OfNoFramesIsRefusedAndSoIsAView) {
  const TempFolder folder;
  for (const char* shape : {"(0, 3, 6)", "(0, 0, 6)"}) {
    const std::string frames = folder.write("frames.npy", npyBytes({}, {.shape = shape}));
    expectFailure(runProgram({"report", frames, "-o", folder.path() / "out"}), 3, "frames.npy: holds no frames");
    expectFailure(runProgram({"view", frames, "-o", folder.path() / "a.html"}), 3, "frames.npy: holds no frames");
  }
  EXPECT_EQ(filesIn(folder.path()), Names{"frames.npy"});
}

#ifdef ALLPAIRS_HAS_FCL

/// A cuboid as a closed mesh.
std::string cuboidText(const std::array<double, 3>& min, const std::array<double, 3>& max) {
  std::ostringstream text;
  for (const double z : {min[2], max[2]}) {
    for (const double y : {min[1], max[1]}) {
      for (const double x : {min[0], max[0]}) text << "v " << x << ' ' << y << ' ' << z << '\n';
    }
  }
  text << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  return text.str();
}

/// Parts of which two are the same, one lies in another, two share 0.25, and a slanted one is apart though boxes
/// overlap.
class ReportOfShapes : public ::testing::Test {
 protected:
  ReportOfShapes() {
    fs::create_directory(m_folder.path() / "parts");
    write("a-block", cuboidText({0, 0, 0}, {4, 4, 4}));
    write("b-pin", cuboidText({1, 1, 1}, {2, 2, 2}));
    write("c-bar", cuboidText({3.75, 1, 1}, {8, 2, 2}));
    write("d-bar", cuboidText({3.75, 1, 1}, {8, 2, 2}));
    write("e-wedge", "v 7.5 1.5 9\nv 7.5 9 1.5\nv 9 9 9\nv 7.5 9 9\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  }

  void write(const std::string& name, const std::string& text) {
    m_folder.write("parts/" + name + ".obj", "o " + name + '\n' + text);
  }

  [[nodiscard]] fs::path report(std::vector<std::string> options = {}) const {
    const fs::path out = m_folder.path() / "out";
    options.insert(options.begin(), {"report", m_folder.path() / "parts", "-o", out});
    expectSuccess(runProgram(options));
    return out;
  }

 private:
  TempFolder m_folder;
};

TEST_F(ReportOfShapes, ListsTheWorstFirstAndOnlyCountsWhatIsApart) {
  const fs::path out = report();
  const std::string table = readBytes(out / "clashes.csv");
  EXPECT_TRUE(
      table.starts_with("number,first,second,state,depth,distance,x,y,z,normal_x,normal_y,normal_z,contacts,guid,"
                        "first_file,first_path,second_file,second_path\n"
                        "1,d-bar,c-bar,duplicate,,0,5.875,1.5,1.5,"))
      << table;
  EXPECT_NE(table.find("\n2,b-pin,a-block,contained,2,0,"), std::string::npos) << table;
  EXPECT_NE(table.find(",clash,0.25,0,3.875,"), std::string::npos) << table;
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5) << table;
  const std::string page = readBytes(out / "index.html");
  EXPECT_NE(page.find("<p class=\"headline\">4 clashes (1 duplicate, 1 contained), 2 apart</p>"), std::string::npos);
  EXPECT_NE(page.find("The worst: d-bar and c-bar. The same shape in the same place"), std::string::npos);
  EXPECT_NE(page.find("b-pin lies wholly in a-block, 2 deep at"), std::string::npos);
  EXPECT_NE(page.find("2 candidates that are apart by their shapes are not shown"), std::string::npos);
}

TEST_F(ReportOfShapes, BoxesAloneAreThereAsBeforeWithTheirOption) {
  const std::string table = readBytes(report({"--boxes"}) / "clashes.csv");
  EXPECT_TRUE(table.starts_with("number,first,second,overlap_x,overlap_y,overlap_z,volume,guid,first_file,")) << table;
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7) << table;
}

TEST_F(ReportOfShapes, WhatOnlyTouchesIsNotTheWorst) {
  const TempFolder folder;
  for (const bool isClash : {false, true}) {
    const std::string boxes =
        folder.write("b.csv", isClash ? "0,0,0,2,1,1\n1,0,0,2,1,1\n" : "0,0,0,1,1,1\n1,0,0,2,1,1\n");
    expectSuccess(runProgram({"report", boxes, "--exact", "-o", folder.path() / "o"}));
    EXPECT_EQ(readBytes(folder.path() / "o/index.html").find("<p class=\"worst\">") != std::string::npos, isClash);
  }
}

TEST_F(ReportOfShapes, WhatIsWithinTheClearanceIsListed) {
  const std::string table = readBytes(report({"--clearance", "5"}) / "clashes.csv");
  EXPECT_NE(table.find("e-wedge,d-bar,clearance,,"), std::string::npos) << table;
}

TEST_F(ReportOfShapes, BcfSaysWhatWasFoundAndLooksAtTheContact) {
  for (const auto& [file, bytes] : filesOf(report() / "clashes.bcf")) {
    if (!file.ends_with("markup.bcf")) continue;
    const pugi::xml_document document = parse(bytes);
    const pugi::xml_node topic = document.child("Markup").child("Topic");
    if (std::string(topic.child_value("Title")) != "c-bar and a-block") continue;
    EXPECT_EQ(std::string(topic.child_value("Description")).find("0.25 deep at (3.875, "), 0U)
        << topic.child_value("Description");
    return;
  }
  ADD_FAILURE() << "no topic of the bar and the block";
}

#else

TEST(Report, WithoutFclSaysThatShapesAreNotTested) {
  const TempFolder folder;
  const std::string mesh = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expectSuccess(runProgram({"report", mesh, "-o", folder.path() / "out"}));
  EXPECT_NE(readBytes(folder.path() / "out/index.html").find("built without FCL"), std::string::npos);
  expectFailure(runProgram({"report", kDemo, "--exact", "-o", folder.path() / "out"}), 2, "--exact needs FCL");
}

#endif

TEST(Report, SaysWhatIsWrong) {
  const TempFolder folder;
  const std::string file = folder.write("file", "");
  expectFailure(runProgram({"report", kDemo, "-o", file + "/out"}), 3, "cannot create this folder");
  expectFailure(runProgram({"report", kDemo, "-o", file}), 3, "is a file; -o takes a folder");
  expectFailure(runProgram({"report", kDemo, "-o", "/dev/null"}), 3, "/dev/null: is a file; -o takes a folder");
  expectFailure(runProgram({"report", kDemo}), 2, "no -o DIR given");
  expectFailure(runProgram({"report", kDemo, "-o", folder.path() / "o", "--metres-per-unit", "0"}), 2,
                "must be above 0");
  expectFailure(runProgram({"report", kDemo, "-o", folder.path() / "o", "--metres-per-unit", "inf"}), 2,
                "must be above 0 and at most 1e18");
  expectFailure(runProgram({"report", kDemo, "-o", folder.path() / "o", "--boxes", "--exact"}), 2, "give one of them");
  expectFailure(runProgram({"report", kDemo, "-o", folder.path() / "o", "--boxes", "--clearance", "1"}), 2,
                "--clearance is measured between shapes, which --boxes does not test");
  expectFailure(runProgram({"report", kDemo, "-o", folder.path() / "o", "--up", "w"}), 2, "'w' is not one of x, y, z");
}

}  // namespace
}  // namespace allpairs::test
