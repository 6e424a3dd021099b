// SPDX-License-Identifier: MIT
// BCF files, whole, and where their cameras stand.
#include "Bcf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ClashPicture.h"
#include "ReportFiles.h"
#include "VectorMath.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using view::BcfVersion;
using view::Change;
using view::ParallelCamera;
using view::ViewScene;
using Point = std::array<double, 3>;

/// A row of two bodies with three pairs of their parts, two of which are the same product, and a part with itself.
ViewScene sceneOfParts() {
  ViewScene scene;
  scene.title = "a & b";
  scene.modelCount = 4;
  scene.names = {"wall", " ", "", "pipe <1>"};
  scene.frames.push_back(
      {.boxes = {{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}, {{0, 1, 1}, {1, 2, 2}}, {{1, 1, 1}, {2, 2, 2}}},
       .flags = {7, 7, 7, 7},
       .pairs = {{1, 0}, {2, 0}, {3, 0}, {3, 3}},
       .excluded = {}});
  scene.bodies = {0, 1, 1, 1};
  scene.bodyNames = {"W", "P"};
  scene.bodyIdentities = {"W", "P"};
  scene.kinds.assign(4, "IfcWall");
  scene.ids = {"0123456789ABCDEFGHab_$", "0123456789ABCDEFGHab_-", "3123456789ABCDEFGHabzZ", "3123456789ABCDEFGHabzZ"};
  return scene;
}

/// The two rows, and a topic that is closed.
std::map<std::string, std::string> bcfFiles(const ViewScene& scene, const view::BcfOptions& options) {
  std::vector<view::Clash> clashes = view::clashesOf(scene);
  for (view::Clash& clash : clashes) clash.guid = "guid" + std::to_string(clash.number);
  clashes[0].since = Change::New;
  clashes[0].before = "touching";
  clashes[1].since = Change::Resolved;
  const TempFolder folder;
  return filesOf(folder.write("a.bcf", view::makeBcf(scene, clashes, options)));
}

view::BcfOptions optionsOf(BcfVersion version, std::span<const view::EarlierClash> gone) {
  view::BcfOptions options;
  options.version = version;
  options.date = "2026-01-31T12:00:00Z";
  options.metresPerUnit = 0.5;
  options.picture = [](const view::Clash& clash) { return "picture " + std::to_string(clash.number); };
  options.gone = gone;
  return options;
}

const std::string kHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

TEST(Bcf, OfVersion21IsThis) {
  const std::vector<view::EarlierClash> gone{{.guid = "gone", .first = "x", .second = "<y>"}};
  auto files = bcfFiles(sceneOfParts(), optionsOf(BcfVersion::V21, gone));
  EXPECT_EQ(files["bcf.version"],
            kHead + "<Version VersionId=\"2.1\">\n  <DetailedVersion>2.1</DetailedVersion>\n</Version>\n");
  EXPECT_EQ(files["guid1/snapshot.png"], "picture 1");
  EXPECT_EQ(files["guid2/snapshot.png"], "picture 2");
  std::string guid = parse(files["guid1/viewpoint.bcfv"]).child("VisualizationInfo").attribute("Guid").value();
  EXPECT_EQ(guid, view::guidOf({"guid1", "viewpoint"}));
  EXPECT_EQ(files["guid1/markup.bcf"], kHead +
                                           R"(<Markup>
  <Header>
    <File isExternal="true">
      <Filename>a &amp; b</Filename>
    </File>
  </Header>
  <Topic Guid="guid1" TopicType="Clash" TopicStatus="Open">
    <Title>P and W</Title>
    <Index>1</Index>
    <Labels>new</Labels>
    <CreationDate>2026-01-31T12:00:00Z</CreationDate>
    <CreationAuthor>Allpairs</CreationAuthor>
    <Description>The bounding boxes overlap by 1, 1, 1; they share a volume of 1. It is the worst of 3 pairs. )"
                                           R"(Before: touching.</Description>
  </Topic>
  <Viewpoints Guid=")" + guid + R"(">
    <Viewpoint>viewpoint.bcfv</Viewpoint>
    <Snapshot>snapshot.png</Snapshot>
    <Index>0</Index>
  </Viewpoints>
</Markup>
)");
  EXPECT_EQ(files["gone/markup.bcf"], kHead + R"(<Markup>
  <Header>
    <File isExternal="true">
      <Filename>a &amp; b</Filename>
    </File>
  </Header>
  <Topic Guid="gone" TopicType="Clash" TopicStatus="Closed">
    <Title>x and &lt;y&gt;</Title>
    <Labels>resolved</Labels>
    <CreationDate>2026-01-31T12:00:00Z</CreationDate>
    <CreationAuthor>Allpairs</CreationAuthor>
    <Description>It was in the report before, and is none any more.</Description>
  </Topic>
</Markup>
)");
  const std::string viewpoint = files["guid1/viewpoint.bcfv"];
  const std::string expected = kHead + "<VisualizationInfo Guid=\"" + guid + R"(">
  <Components>
    <Selection>
      <Component>
        <OriginatingSystem>Allpairs</OriginatingSystem>
        <AuthoringToolId>model 1</AuthoringToolId>
      </Component>
      <Component IfcGuid="0123456789ABCDEFGHab_$">
        <OriginatingSystem>Allpairs</OriginatingSystem>
        <AuthoringToolId>wall</AuthoringToolId>
      </Component>
      <Component IfcGuid="3123456789ABCDEFGHabzZ">
        <OriginatingSystem>Allpairs</OriginatingSystem>
        <AuthoringToolId>model 2</AuthoringToolId>
      </Component>
    </Selection>
    <Visibility DefaultVisibility="true" />
    <Coloring>
      <Color Color="FF0072B2">
        <Component>
          <OriginatingSystem>Allpairs</OriginatingSystem>
          <AuthoringToolId>model 1</AuthoringToolId>
        </Component>
      </Color>
      <Color Color="FFE69F00">
        <Component IfcGuid="0123456789ABCDEFGHab_$">
          <OriginatingSystem>Allpairs</OriginatingSystem>
          <AuthoringToolId>wall</AuthoringToolId>
        </Component>
      </Color>
    </Coloring>
  </Components>
  <OrthogonalCamera>
)";
  EXPECT_EQ(viewpoint.substr(0, expected.size()), expected);
  EXPECT_EQ(files.size(), 1 + 2 * 3 + 1U);
}

TEST(Bcf, OfVersion30IsThis) {
  const std::vector<view::EarlierClash> gone{{.guid = "gone", .first = "x", .second = "y"}};
  auto files = bcfFiles(sceneOfParts(), optionsOf(BcfVersion::V30, gone));
  EXPECT_EQ(files["bcf.version"], kHead + "<Version VersionId=\"3.0\" />\n");
  EXPECT_EQ(files["extensions.xml"], kHead + R"(<Extensions>
  <TopicTypes>
    <TopicType>Clash</TopicType>
    <TopicType>Contact</TopicType>
    <TopicType>Clearance</TopicType>
    <TopicType>Undecided</TopicType>
  </TopicTypes>
  <TopicStatuses>
    <TopicStatus>Open</TopicStatus>
    <TopicStatus>In progress</TopicStatus>
    <TopicStatus>Accepted</TopicStatus>
    <TopicStatus>Closed</TopicStatus>
  </TopicStatuses>
  <TopicLabels>
    <TopicLabel>new</TopicLabel>
    <TopicLabel>persisting</TopicLabel>
    <TopicLabel>resolved</TopicLabel>
  </TopicLabels>
</Extensions>
)");
  const std::string guid = view::guidOf({"guid2", "viewpoint"});
  EXPECT_EQ(files["guid2/markup.bcf"], kHead + R"(<Markup>
  <Header>
    <Files>
      <File IsExternal="true">
        <Filename>a &amp; b</Filename>
      </File>
    </Files>
  </Header>
  <Topic Guid="guid2" TopicType="Clash" TopicStatus="Closed">
    <Title>pipe &lt;1&gt; with itself</Title>
    <Index>2</Index>
    <Labels>
      <Label>resolved</Label>
    </Labels>
    <CreationDate>2026-01-31T12:00:00Z</CreationDate>
    <CreationAuthor>Allpairs</CreationAuthor>
    <Description>The model may touch itself.</Description>
    <Viewpoints>
      <ViewPoint Guid=")" + guid + R"(">
        <Viewpoint>viewpoint.bcfv</Viewpoint>
        <Snapshot>snapshot.png</Snapshot>
        <Index>0</Index>
      </ViewPoint>
    </Viewpoints>
  </Topic>
</Markup>
)");
  const std::string viewpoint = files["guid2/viewpoint.bcfv"];
  const std::string expected = R"(    <Coloring>
      <Color Color="FF0072B2">
        <Components>
          <Component IfcGuid="3123456789ABCDEFGHabzZ">
            <OriginatingSystem>Allpairs</OriginatingSystem>
            <AuthoringToolId>pipe &lt;1&gt;</AuthoringToolId>
          </Component>
        </Components>
      </Color>
    </Coloring>
)";
  EXPECT_NE(viewpoint.find(expected), std::string::npos) << viewpoint;
  EXPECT_EQ(files.size(), 2 + 2 * 3 + 1U);
}

TEST(Bcf, TopicsAreOfTheTypeOfTheirState) {
  const std::vector<std::string> types{"Clash", "Clash", "Clash", "Contact", "Undecided", "Clearance", "Undecided"};
  for (std::size_t i = 0; i < types.size(); ++i) {
    ViewScene scene = sceneOfParts();
    scene.frames.front().pairs.resize(1);
    scene.isExact = true;
    scene.exact.resize(1);
    scene.exact.front().state = static_cast<ExactState>(i);
    view::Clash clash = view::clashOf(scene, 0);
    clash.guid = "guid";
    const TempFolder folder;
    auto files = filesOf(folder.write("a.bcf", view::makeBcf(scene, {&clash, 1}, optionsOf(BcfVersion::V21, {}))));
    const pugi::xml_document markup = parse(files["guid/markup.bcf"]);
    EXPECT_EQ(markup.child("Markup").child("Topic").attribute("TopicType").value(), types[i]) << i;
  }
}

Point bcfPoint(const pugi::xml_node& element) {
  return {element.child("X").text().as_double(), element.child("Y").text().as_double(),
          element.child("Z").text().as_double()};
}

TEST(Bcf, TheCameraStandsInMetresTwiceItsHeightBeforeWhatItLooksAt) {
  const ViewScene scene = sceneOfParts();
  const ParallelCamera expected = cameraOf(scene, view::clashesOf(scene).front());
  for (const BcfVersion version : {BcfVersion::V21, BcfVersion::V30}) {
    auto files = bcfFiles(scene, optionsOf(version, {}));
    const pugi::xml_document viewpoint = parse(files["guid1/viewpoint.bcfv"]);
    const pugi::xml_node camera = viewpoint.child("VisualizationInfo").child("OrthogonalCamera");
    EXPECT_EQ(bcfPoint(camera.child("CameraDirection")), expected.direction);
    EXPECT_EQ(bcfPoint(camera.child("CameraUpVector")), expected.up);
    EXPECT_EQ(camera.child("ViewToWorldScale").text().as_double(), 0.5 * expected.height);
    const Point eye = bcfPoint(camera.child("CameraViewPoint"));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double ahead = expected.height * expected.direction[axis];
      EXPECT_NEAR(eye[axis], 0.5 * expected.centre[axis] - ahead, 1e-14);
    }
    EXPECT_EQ(!camera.child("AspectRatio").empty(), version == BcfVersion::V30);
  }
}

/// Two boxes, and what their shapes say, if anything.
ParallelCamera cameraOfTwo(const Box& a, const Box& b, const std::optional<ExactPair>& exact, int up = 3) {
  ViewScene scene;
  scene.modelCount = 2;
  scene.frames.push_back({.boxes = {a, b}, .flags = {7, 7}, .pairs = {{1, 0}}, .excluded = {}});
  scene.isExact = exact.has_value();
  if (exact) scene.exact = {*exact};
  scene.up = up;
  return cameraOf(scene, view::clashOf(scene, 0));
}

double diagonalOf(const Box& box) {
  return std::hypot(box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]);
}

void expectCamera(const ParallelCamera& camera, const Box& centred, double height) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(camera.centre[axis], (centred.min[axis] + centred.max[axis]) / 2.0, 1e-12) << axis;
  EXPECT_NEAR(camera.height, height, 1e-12);
}

TEST(Camera, ShowsBothBoxesOrTheSmallerAndWhatIsShared) {
  const Box a{{0, 0, 0}, {2, 2, 2}};
  const Box b{{1, 1, 1}, {4, 4, 4}};
  const Box both{{0, 0, 0}, {4, 4, 4}};
  expectCamera(cameraOfTwo(a, b, {}), both, 1.15 * diagonalOf(both));
  const Box large{{-90, 0, 0}, {0.5, 90, 90}};
  const Box shared{{0, 0, 0}, {2, 2, 2}};
  expectCamera(cameraOfTwo(a, large, {}), shared, 1.15 * diagonalOf(shared));
  expectCamera(cameraOfTwo(large, a, {}), shared, 1.15 * diagonalOf(shared));
  const Box small{{1, 1, 1}, {1.5, 1.5, 1.5}};
  expectCamera(cameraOfTwo(a, small, {}), a, 1.15 * diagonalOf(a));  // four times as large is not much larger
  expectCamera(cameraOfTwo(small, a, {}), a, 1.15 * diagonalOf(a));
}

TEST(Camera, ShowsTheContactOfShapesWithRoomAroundIt) {
  const Box a{{0, 0, 0}, {2, 2, 2}};
  const Box b{{1, 1, 1}, {4, 4, 4}};
  ExactPair pair;
  pair.state = ExactState::WithinClearance;
  pair.pointOnFirst = {1, 1, 1};
  pair.pointOnSecond = {1, 1, 2};
  const Box gap{pair.pointOnFirst, pair.pointOnSecond};
  expectCamera(cameraOfTwo(a, b, pair), gap, 3.0);
  pair.pointOnSecond = {1, 1, 1.5};
  expectCamera(cameraOfTwo(a, b, pair), {{1, 1, 1}, {1, 1, 1.5}}, 0.75 * diagonalOf(a));
  pair.pointOnSecond = {1, 1, 4};
  const Box both{{0, 0, 0}, {4, 4, 4}};
  expectCamera(cameraOfTwo(a, b, pair), both, 1.15 * diagonalOf(both));  // no more than both
  pair.state = ExactState::NotExamined;
  expectCamera(cameraOfTwo(a, b, pair), both, 1.15 * diagonalOf(both));
}

TEST(Camera, LooksDownAndStandsUprightWhereverUpIs) {
  const Box a{{0, 0, 0}, {2, 2, 2}};
  const double length = std::sqrt(0.48 * 0.48 + 0.72 * 0.72 + 0.5 * 0.5);
  const auto directionOf = [&](int up) {
    Point direction = cameraOfTwo(a, a, {}, up).direction;
    for (double& part : direction) part = std::round(part * length * 1e9) / 1e9;
    return direction;
  };
  EXPECT_EQ(directionOf(3), (Point{-0.48, 0.72, -0.5}));
  EXPECT_EQ(directionOf(-3), (Point{0.48, 0.72, 0.5}));
  EXPECT_EQ(directionOf(2), (Point{-0.48, -0.5, -0.72}));
  EXPECT_EQ(directionOf(-2), (Point{0.48, 0.5, -0.72}));
  EXPECT_EQ(directionOf(1), (Point{-0.5, -0.48, 0.72}));
  EXPECT_EQ(directionOf(-1), (Point{0.5, 0.48, 0.72}));
  for (const int up : {-3, -2, -1, 1, 2, 3}) {
    const ParallelCamera camera = cameraOfTwo(a, a, {}, up);
    const std::size_t axis = static_cast<std::size_t>(std::abs(up)) - 1;
    EXPECT_GT(up < 0 ? -camera.up[axis] : camera.up[axis], 0.8) << up;
    EXPECT_NEAR(view::dot(camera.up, camera.direction), 0.0, 1e-15) << up;
    EXPECT_NEAR(view::dot(camera.up, camera.up), 1.0, 1e-15) << up;
  }
}

}  // namespace
}  // namespace allpairs::test
