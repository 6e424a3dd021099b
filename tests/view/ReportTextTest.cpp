// SPDX-License-Identifier: MIT
// What reports say, whole: sentences, pages and tables of scenes made by hand.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "Clash.h"
#include "PageTemplate.h"
#include "Report.h"
#include "Since.h"

namespace allpairs::test {
namespace {

using view::Change;
using view::Clash;
using view::ViewScene;

/// Two models, and what their shapes say.
struct OfShapes {
  ViewScene scene{};

  explicit OfShapes(const ExactPair& pair) {
    scene.modelCount = 2;
    scene.names = {"a", "b"};
    scene.frames.push_back({.boxes = {{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}},
                            .flags = {7, 7},
                            .pairs = {{1, 0}},
                            .excluded = {}});
    scene.isExact = true;
    scene.exact = {pair};
  }

  [[nodiscard]] std::string finding() const { return view::findingOf(scene, view::clashOf(scene, 0)); }
};

ExactPair exactPair(ExactState state) {
  ExactPair pair;
  pair.state = state;
  pair.pointOnFirst = {1, 2, 3};
  pair.pointOnSecond = {1, 2, 4};
  pair.normal = {0, 0, -1};
  return pair;
}

TEST(Finding, SaysOfShapesWhatTheirStateIsAndWhere) {
  ExactPair pair = exactPair(ExactState::Duplicate);
  EXPECT_EQ(OfShapes(pair).finding(), "The same shape in the same place, around (1, 2, 3.5).");
  pair.state = ExactState::Clash;
  pair.depth = 1.0;
  EXPECT_EQ(OfShapes(pair).finding(), "1 deep at (1, 2, 3.5), along (0, 0, -1).");
  pair.state = ExactState::Contained;
  EXPECT_EQ(OfShapes(pair).finding(), "a lies wholly in b, 1 deep at (1, 2, 4).");
  pair.isFirstInner = true;
  EXPECT_EQ(OfShapes(pair).finding(), "b lies wholly in a, 1 deep at (1, 2, 3).");
  pair.state = ExactState::Touching;
  pair.contactBox = {{4, 4, 4}, {6, 6, 6}};
  pair.depth = 0.0;
  EXPECT_EQ(OfShapes(pair).finding(), "They touch at (5, 5, 5).");
  pair.distance = 1.0;
  for (const ExactState state : {ExactState::WithinClearance, ExactState::Apart}) {
    pair.state = state;
    EXPECT_EQ(OfShapes(pair).finding(), "They are 1 apart, between (1, 2, 3) and (1, 2, 4).");
  }
  pair.state = ExactState::NotExamined;
  EXPECT_EQ(OfShapes(pair).finding(), "Their shapes could not be examined.");
  OfShapes self(pair);
  self.scene.frames.front().pairs = {{1, 1}};
  EXPECT_EQ(self.finding(), "The model may touch itself.");
}

TEST(Finding, SaysWhichSurfaceIsOpenThatLeavesItUnknown) {
  ExactPair pair = exactPair(ExactState::Clash);
  pair.isFirstOpen = true;
  const std::string crosses = "Surfaces cross at (1, 2, 3.5). How deep is not known: ";
  EXPECT_EQ(OfShapes(pair).finding(), crosses + "the surface of b is not closed.");
  pair.isSecondOpen = true;
  EXPECT_EQ(OfShapes(pair).finding(), crosses + "the surfaces of both are not closed.");
  pair.isFirstOpen = false;
  EXPECT_EQ(OfShapes(pair).finding(), crosses + "the surface of a is not closed.");
  pair.state = ExactState::Undecided;
  pair.distance = 1.0;
  EXPECT_EQ(OfShapes(pair).finding(),
            "Surfaces are 1 apart, between (1, 2, 3) and (1, 2, 4). Whether one lies in the other is not known: "
            "the surface of a is not closed.");
}

TEST(Finding, SaysOfBoxesWhatTheyShareOrOnWhichAxisTheyAreApart) {
  OfShapes boxes(exactPair(ExactState::Clash));
  boxes.scene.isExact = false;
  EXPECT_EQ(boxes.finding(), "The bounding boxes overlap by 1, 1, 1; they share a volume of 1.");
  boxes.scene.frames.front().boxes[1] = {{2, 1, 1}, {3, 3, 1.5}};
  EXPECT_EQ(boxes.finding(), "The bounding boxes overlap by 0, 1, 0.5; they share a volume of 0.");
  boxes.scene.frames.front().boxes[1] = {{2.25, 1, 2.5}, {3, 3, 3}};
  EXPECT_EQ(boxes.finding(),
            "The bounding boxes do not overlap, but lie within the distance: they are 0.5 apart on z.");
  boxes.scene.frames.front().pairs = {{1, 1}};
  EXPECT_EQ(boxes.finding(), "The model may touch itself.");
}

TEST(Finding, BoxesThatMeetAtInfinityTouchThere) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  OfShapes boxes(exactPair(ExactState::Clash));
  boxes.scene.isExact = false;
  boxes.scene.frames.front().boxes = {{{kInfinite, 0, 0}, {kInfinite, 2, 2}}, {{0, 1, 0}, {kInfinite, 3, kInfinite}}};
  EXPECT_EQ(boxes.finding(), "The bounding boxes overlap by 0, 1, 2; they share a volume of 0.");
  boxes.scene.frames.front().boxes[1].min[1] = 2.5;
  EXPECT_EQ(boxes.finding(),
            "The bounding boxes do not overlap, but lie within the distance: they are 0.5 apart on y.");
}

TEST(Finding, CoordinatesThatAreNothingBesideTheLargestAreZero) {
  EXPECT_EQ(view::coordinatesOf({1e6, 1e-3, -2e-3}), (std::array<std::string, 3>{"1000000", "0", "-0.002"}));
  EXPECT_EQ(view::coordinatesOf({1e-6, -1e-14, 1e-16}), (std::array<std::string, 3>{"0.000001", "-1e-14", "0"}));
}

TEST(Finding, CoordinatesFarFromTheOriginTellHundredthsApart) {
  // The same list is in web/test/rules.test.mjs, for the page.
  const std::vector<std::pair<double, std::string>> numbers{{123463.75, "123463.75"},
                                                            {-5400123.456, "-5400123.46"},
                                                            {999.996, "1000"},
                                                            {1234.56, "1234.56"},
                                                            {12.34567, "12.346"},
                                                            {1e6, "1000000"},
                                                            {123456789012.34, "123456789012.34"},
                                                            {12345678901234.56, "12345678901234.6"}};
  for (const auto& [value, text] : numbers)
    EXPECT_EQ(view::coordinatesOf({value, value, value}), (std::array{text, text, text}));
}

/// Bodies of which one has two models, with three rows that are shown and a pair that is apart.
ViewScene sceneOfBodies() {
  ViewScene scene;
  scene.title = "parts & <more>";
  scene.method = "shapes; clashes are deeper than 0.1";
  scene.modelCount = 4;
  scene.names = {"a<", "b", "=c", "d,\"d\""};
  scene.frames.push_back(
      {.boxes = {{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}, {{1, 1, 0}, {4, 4, 4}}, {{0, 0, 0}, {1, 1, 1}}},
       .flags = {7, 7, 7, 7},
       .pairs = {{1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}},
       .excluded = {}});
  scene.isExact = true;
  scene.clearance = 0.25;
  ExactPair clash = exactPair(ExactState::Clash);
  clash.depth = 1.0;
  clash.contactCount = 7;
  ExactPair near = exactPair(ExactState::WithinClearance);
  near.distance = 0.125;
  scene.exact = {clash, exactPair(ExactState::Touching), near, exactPair(ExactState::Apart),
                 exactPair(ExactState::NotExamined)};
  scene.bodies = {0, 1, 1, 2};
  scene.bodyNames = {"A", "B&", "D"};
  scene.bodyIdentities = {"idA", "B", "D"};
  scene.kinds = {"IfcSlab", "IfcWall", "", ""};
  scene.ids = {"idA", "idB", "", ""};
  scene.fileNames = {"x.ifc", "y.ifc"};
  scene.files = {0, 0, 0, 1};
  scene.paths = {"/a", "/b", "/c", "/d"};
  scene.ignored = {{"x.ifc", 3, "hull", "why <not>", false}};
  return scene;
}

view::Since sinceMonday() {
  view::EarlierClash gone{.guid = "00000000-0000-8000-8000-000000000000", .first = "p&", .second = "'=q"};
  gone.places = {{{"x.ifc", "/p"}, {"y.ifc", "/q,"}}};
  return {.name = "mon<day", .added = 1, .persisting = 1, .resolved = 2, .gone = {gone}};
}

std::vector<Clash> markedClashes(const ViewScene& scene) {
  std::vector<Clash> clashes = view::clashesOf(scene);
  const std::array<Change, 3> changes{Change::New, Change::Persisting, Change::Resolved};
  for (std::size_t i = 0; i < clashes.size(); ++i) {
    clashes[i].guid = "guid" + std::to_string(i);
    clashes[i].since = changes.at(i);
  }
  clashes.front().before = "touching";
  return clashes;
}

std::string textOfReport(const view::Report& report, void (*write)(const view::Report&, scene::ByteSink)) {
  std::string text;
  write(report, [&text](std::string_view part) { text += part; });
  return text;
}

/// The page of a report without what is of all pages: its title, and what stands in the place for a report.
std::string contentOf(const view::Report& report) {
  const std::string page = textOfReport(report, view::writeReportPage);
  const std::string_view all = view::reportTemplate();
  const std::string_view beforeTitle = all.substr(0, all.find("<!--ALLPAIRS-TITLE-->"));
  const std::string_view between = all.substr(beforeTitle.size() + std::string_view("<!--ALLPAIRS-TITLE-->").size());
  const std::string_view before = between.substr(0, between.find("<!--ALLPAIRS-REPORT-->"));
  const std::string_view behind = between.substr(before.size() + std::string_view("<!--ALLPAIRS-REPORT-->").size());
  const std::size_t place = page.find(before, beforeTitle.size());
  if (!page.starts_with(beforeTitle) || place == std::string::npos || !page.ends_with(behind)) return "another page";
  const std::size_t begin = place + before.size();
  return page.substr(beforeTitle.size(), place - beforeTitle.size()) + '\n' +
         page.substr(begin, page.size() - behind.size() - begin);
}

TEST(ReportText, OfShapesAndBodiesIsThisPage) {
  const ViewScene scene = sceneOfBodies();
  const view::Since since = sinceMonday();
  const std::vector<Clash> clashes = markedClashes(scene);
  const view::Report report{scene, clashes, 1, &since, {{"Made", "<now>"}, {"By", "us"}}, ""};
  const std::string expected =
      R"(parts &amp; &lt;more&gt; – clashes
<h1>parts &amp; &lt;more&gt;</h1>
<p class="headline">1 clash, 1 within the clearance, 1 not examined, 1 apart</p>
<p class="worst">Since mon&lt;day: 1 new, 1 persisting, 2 resolved.</p>
<details><summary>Resolved, and no longer listed</summary><ul><li>p&amp; and &#39;=q</li></ul></details>
<p class="worst">The worst: B&amp; and A. 1 deep at (1, 2, 3.5), along (0, 0, -1).</p>
<p>4 models, 5 candidates by their boxes. Shapes; clashes are deeper than 0.1. Pairs that belong together are one )"
      R"(row: the worst of them. Clearance 0.25. 1 candidate that is apart by its shapes is not shown.</p>
<details><summary>1 part of the input left out, and not tested</summary><ul><li>x.ifc:3: hull: why &lt;not&gt;</li>)"
      R"(</ul></details>
<dl class="about"><div><dt>Made</dt><dd>&lt;now&gt;</dd></div><div><dt>By</dt><dd>us</dd></div></dl>
<p>Shapes were tested. Duplicates come first, then contained parts, then clashes, the deepest first. Red is where )"
      R"(surfaces cross, and a line with two ends is the depth, or the gap.</p>
<p><a href="view.html">Open it in 3D</a>; a picture opens its pair. Also in this folder: <a href="clashes.csv">)"
      R"(clashes.csv</a>, <a href="clashes.bcf">clashes.bcf</a>. The first 1 have pictures and are in the BCF file.</p>
<section class="clashes">
<figure id="clash-1" data-guid="guid0" data-status="Open"><a href="view.html#pair=@1,@0" title="Open it in 3D">)"
      R"(<img src="pictures/0001.png" alt="B&amp; and A" width="640" height="480" loading="lazy"></a><figcaption>1. )"
      R"(<span class="first">B&amp;</span><br><span class="second">A</span><br><span class="fact">IfcSlab idA</span><br>)"
      R"(<span class="fact"><span class="state clash">clash</span> <span class="state new">new</span> )"
      R"(1 deep at (1, 2, 3.5), along (0, 0, -1). Before: touching.</span><details><summary>2 pairs of their parts)"
      R"(</summary><ul><li><span class="state clash">clash</span> <span class="state new">new</span> )"
      R"(b and a&lt;: 1 deep at (1, 2, 3.5), along (0, 0, -1).</li><li><span class="state touching">touching</span> )"
      R"(=c and a&lt;: They touch at (1, 2, 3.5).</li></ul></details></figcaption></figure>
</section>
<div class="scroll"><table>
<thead><tr><th class="number">#</th><th>state</th><th>first</th><th>second</th><th class="number">depth</th>)"
      R"(<th class="number">distance</th><th class="number">at x</th><th class="number">y</th><th class="number">z</th>)"
      R"(</tr></thead>
<tbody>
<tr data-guid="guid0"><td class="number"><a href="#clash-1">1</a></td><td data-order="2"><span class="state clash">)"
      R"(clash</span> <span class="state new">new</span> </td><td>B&amp;</td><td>A (worst of 2 pairs)</td>)"
      R"(<td class="number">1</td><td class="number"></td><td class="number">1</td><td class="number">2</td>)"
      R"(<td class="number">3.5</td></tr>
<tr data-guid="guid1"><td class="number">2</td><td data-order="5"><span class="state clearance">clearance</span> )"
      R"(<span class="state persisting">persisting</span> </td><td>d,&quot;d&quot;</td><td>a&lt;</td>)"
      R"(<td class="number"></td><td class="number">0.125</td><td class="number">1</td><td class="number">2</td>)"
      R"(<td class="number">3.5</td></tr>
<tr data-guid="guid2"><td class="number">3</td><td data-order="6"><span class="state not-examined">not-examined</span> )"
      R"(<span class="state resolved">resolved</span> </td><td>=c</td><td>b</td><td class="number"></td>)"
      R"(<td class="number"></td><td class="number"></td><td class="number"></td><td class="number"></td></tr>
</tbody>
</table></div>
)";
  EXPECT_EQ(contentOf(report), expected);
}

TEST(ReportText, OfShapesAndBodiesIsThisTable) {
  const ViewScene scene = sceneOfBodies();
  const view::Since since = sinceMonday();
  const std::vector<Clash> clashes = markedClashes(scene);
  EXPECT_EQ(textOfReport({scene, clashes, 1, &since}, view::writeReportCsv),
            R"(number,first,second,state,depth,distance,x,y,z,normal_x,normal_y,normal_z,contacts,first_type,first_id,)"
            R"(second_type,second_id,since,guid,first_file,first_path,second_file,second_path
1,b,a<,clash,1,0,1,2,3.5,0,0,-1,7,IfcWall,idB,IfcSlab,idA,new,guid0,x.ifc,/b,x.ifc,/a
1,'=c,a<,touching,,0,1,2,3.5,0,0,-1,0,,,IfcSlab,idA,new,guid0,x.ifc,/c,x.ifc,/a
2,"d,""d""",a<,clearance,,0.125,1,2,3.5,0,0,-1,0,,,IfcSlab,idA,persisting,guid1,y.ifc,/d,x.ifc,/a
3,'=c,b,not-examined,,,,,,,,,,,,IfcWall,idB,resolved,guid2,x.ifc,/c,x.ifc,/b
,p&,''=q,,,,,,,,,,,,,,,resolved,00000000-0000-8000-8000-000000000000,x.ifc,/p,y.ifc,"/q,"
)");
}

TEST(ReportText, OfAnyLetterThatIsNotAsciiIsSaidToBeUtf8) {
  const auto isMarked = [](const ViewScene& scene, const view::Since& since) {
    return textOfReport({scene, {}, 0, &since}, view::writeReportCsv).starts_with("\xEF\xBB\xBFnumber,");
  };
  EXPECT_FALSE(isMarked(sceneOfBodies(), sinceMonday()));
  for (const auto texts :
       {&ViewScene::names, &ViewScene::paths, &ViewScene::fileNames, &ViewScene::kinds, &ViewScene::ids}) {
    ViewScene scene = sceneOfBodies();
    (scene.*texts)[1] = "T\u00fcr";
    EXPECT_TRUE(isMarked(scene, sinceMonday()));
  }
  for (std::size_t i = 0; i < 6; ++i) {
    view::Since since = sinceMonday();
    view::EarlierClash& gone = since.gone.front();
    const std::array texts{&gone.first,          &gone.second,         &gone.places[0].file,
                           &gone.places[0].path, &gone.places[1].file, &gone.places[1].path};
    *texts.at(i) = "T\u00fcr";
    EXPECT_TRUE(isMarked(sceneOfBodies(), since)) << "of a row that is gone " << i;
  }
}

/// Two boxes that overlap, one of which may touch itself.
ViewScene sceneOfBoxes() {
  ViewScene scene;
  scene.title = "boxes";
  scene.method = "boxes";
  scene.modelCount = 2;
  scene.frames.push_back({.boxes = {{{0, 0, 0}, {2, 2, 2}}, {{1, 1.5, 1.75}, {3, 3, 3}}},
                          .flags = {7, 7},
                          .pairs = {{1, 1}, {1, 0}},
                          .excluded = {}});
  return scene;
}

TEST(ReportText, OfBoxesIsThisPage) {
  const ViewScene scene = sceneOfBoxes();
  std::vector<Clash> clashes = view::clashesOf(scene);
  for (Clash& clash : clashes) clash.guid = "guid" + std::to_string(clash.number);
  const view::Report report{scene, clashes, 2, nullptr, {}, "too & much"};
  const std::string expected =
      R"(boxes – clashes
<h1>boxes</h1>
<p class="headline">2 pairs of boxes</p>
<p>2 models, 2 candidates by their boxes.</p>
<p>A pair is two models whose axis-aligned bounding boxes are near enough: they may touch, and only a look at their )"
      R"(shapes says whether they do. Red is what the two boxes share. The largest comes first; models that may touch )"
      R"(themselves come last.</p>
<p>Not in 3D: too &amp; much. Also in this folder: <a href="clashes.csv">clashes.csv</a>, <a href="clashes.bcf">)"
      R"(clashes.bcf</a>.</p>
<section class="clashes">
<figure id="clash-1" data-guid="guid1" data-status="Open"><img src="pictures/0001.png" alt="1 and 0" width="640" )"
      R"(height="480" loading="lazy"><figcaption>1. <span class="first">1</span><br><span class="second">0</span><br>)"
      R"(<span class="fact">The bounding boxes overlap by 1, 0.5, 0.25; they share a volume of 0.125.</span>)"
      R"(</figcaption></figure>
<figure id="clash-2" data-guid="guid2" data-status="Open"><img src="pictures/0002.png" alt="1 with itself" )"
      R"(width="640" height="480" loading="lazy"><figcaption>2. )"
      R"(<span class="first">1</span> with itself<br><span class="fact">)"
      R"(The model may touch itself.</span></figcaption></figure>
</section>
<div class="scroll"><table>
<thead><tr><th class="number">#</th><th>first</th><th>second</th><th class="number">overlap x</th>)"
      R"(<th class="number">y</th><th class="number">z</th><th class="number">shared volume</th></tr></thead>
<tbody>
<tr data-guid="guid1"><td class="number"><a href="#clash-1">1</a></td><td>1</td><td>0</td><td class="number">1</td>)"
      R"(<td class="number">0.5</td><td class="number">0.25</td><td class="number">0.125</td></tr>
<tr data-guid="guid2"><td class="number"><a href="#clash-2">2</a></td><td>1</td><td>itself</td><td class="number">2)"
      R"(</td><td class="number">1.5</td><td class="number">1.25</td><td class="number">3.75</td></tr>
</tbody>
</table></div>
)";
  EXPECT_EQ(contentOf(report), expected);
  EXPECT_EQ(textOfReport(report, view::writeReportCsv),
            "number,first,second,overlap_x,overlap_y,overlap_z,volume,guid\n"
            "1,1,0,1,0.5,0.25,0.125,guid1\n2,1,1,2,1.5,1.25,3.75,guid2\n");
}

/// What stands in a report's page without rows.
std::string emptyContent(const std::string& headline, const std::string& scope, const std::string& last) {
  return "t – clashes\n<h1>t</h1>\n<p class=\"headline\">" + headline + "</p>\n<p>" + scope + "</p>\n<p>" + last +
         "</p>\n<section class=\"clashes\">\n</section>\n";
}

TEST(ReportText, WithoutRowsSaysWhy) {
  ViewScene scene;
  scene.title = "t";
  scene.method = "boxes";
  scene.frames.emplace_back();
  const auto page = [&scene] { return contentOf({scene, {}}); };
  EXPECT_EQ(page(),
            emptyContent("0 pairs of boxes", "0 models, 0 candidates by their boxes.", "The input has no models."));
  scene.modelCount = 1;
  EXPECT_EQ(page(), emptyContent("0 pairs of boxes", "1 model, 0 candidates by their boxes.",
                                 "No pair was found: there is nothing to look at."));
  scene.modelCount = 3;
  scene.isExact = true;
  scene.exact.assign(2, exactPair(ExactState::Apart));
  scene.frames.front().pairs = {{1, 0}, {2, 0}};
  EXPECT_EQ(page(),
            emptyContent("0 clashes, 2 apart",
                         "3 models, 2 candidates by their boxes. 2 candidates that are apart by their shapes are "
                         "not shown.",
                         "No two models touch: there is nothing to look at."));
}

std::size_t timesIn(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(ReportText, ListsTwentyPartsOfARowAndTenThousandRows) {
  constexpr std::size_t kRows = 10'001;
  ViewScene scene = sceneOfBoxes();
  std::vector<Clash> clashes(kRows, view::clashOf(scene, 1));
  for (std::size_t i = 0; i < kRows; ++i) clashes[i].number = i + 1;
  scene.bodies = {0, 1};
  scene.bodyNames = {"A", "B"};
  clashes.front().inside.resize(20);
  scene.ignored.assign(kRows, {"a.obj", 1, "x", "y", false});
  std::string text = contentOf({scene, clashes, 1});
  EXPECT_EQ(timesIn(text, "</tr>\n"), 10'000U);
  EXPECT_EQ(timesIn(text, "<li>a.obj:1: x: y</li>"), 10'000U);
  EXPECT_EQ(timesIn(text, " The table here has the first 10000, clashes.csv has all."), 1U);
  EXPECT_EQ(timesIn(text, "<li>0 and itself: "), 20U);
  EXPECT_EQ(timesIn(text, ", in clashes.csv</li>"), 0U);
  clashes.front().inside.resize(22);
  clashes.pop_back();
  scene.ignored.clear();
  text = contentOf({scene, clashes, 1});
  EXPECT_EQ(timesIn(text, "</tr>\n"), 10'000U);
  EXPECT_EQ(timesIn(text, "The table here"), 0U);
  EXPECT_EQ(timesIn(text, "<li>0 and itself: "), 20U);
  EXPECT_EQ(timesIn(text, "<li>and 2 more, in clashes.csv</li>"), 1U);
}

TEST(ReportText, KnowsTheUnits) {
  const std::vector<std::pair<double, std::string>> units{
      {1.0, "metres"},     {1e-3, "millimetres"},        {0.01F, "centimetres"},
      {1e3, "kilometres"}, {0.0254, "inches"},           {0.3048F, "feet"},
      {0.9144F, "yards"},  {1.0 + 2e-6, "units of 1 m"}, {0.7, "units of 0.7 m"}};
  for (const auto& [metres, text] : units) EXPECT_EQ(view::unitText(metres), text);
}

}  // namespace
}  // namespace allpairs::test
