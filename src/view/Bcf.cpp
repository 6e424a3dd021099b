// SPDX-License-Identifier: MIT
#include "Bcf.h"

#include <fmt/format.h>

#include "ClashPicture.h"
#include "Xml.h"
#include "Zip.h"

namespace allpairs::view {
namespace {

constexpr const char* kHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

std::string viewpointGuid(const Clash& clash) { return guidOf({clash.guid, "viewpoint"}); }

std::string descriptionOf(const Clash& clash) {
  if (clash.isSelf()) return "The model may touch itself.";
  return fmt::format("The bounding boxes overlap by {:.6g}, {:.6g}, {:.6g}; they share a volume of {:.6g}.",
                     clash.overlap[0], clash.overlap[1], clash.overlap[2], clash.volume);
}

std::string markup(const ViewScene& scene, const Clash& clash, const BcfOptions& options) {
  std::string text = kHead;
  text += fmt::format("<Markup>\n  <Header><File isExternal=\"true\"><Filename>{}</Filename></File></Header>\n",
                      escapeXml(scene.title));
  text += fmt::format("  <Topic Guid=\"{}\" TopicType=\"Clash\" TopicStatus=\"Open\">\n", clash.guid);
  text += fmt::format("    <Title>{}</Title>\n    <Index>{}</Index>\n", escapeXml(titleOf(scene, clash)), clash.number);
  text +=
      fmt::format("    <CreationDate>{}</CreationDate>\n    <CreationAuthor>Allpairs</CreationAuthor>\n", options.date);
  text += fmt::format("    <Description>{}</Description>\n  </Topic>\n", descriptionOf(clash));
  text += fmt::format("  <Viewpoints Guid=\"{}\">\n    <Viewpoint>viewpoint.bcfv</Viewpoint>\n", viewpointGuid(clash));
  return text + "    <Snapshot>snapshot.png</Snapshot>\n    <Index>0</Index>\n  </Viewpoints>\n</Markup>\n";
}

std::string vector(const char* name, const std::array<double, 3>& v) {
  return fmt::format("    <{0}><X>{1}</X><Y>{2}</Y><Z>{3}</Z></{0}>\n", name, v[0], v[1], v[2]);
}

std::string component(const std::string& name) {
  return fmt::format(
      "      <Component><OriginatingSystem>Allpairs</OriginatingSystem>"
      "<AuthoringToolId>{}</AuthoringToolId></Component>\n",
      escapeXml(name));
}

std::string viewpoint(const ViewScene& scene, const Clash& clash, double metresPerUnit) {
  const ParallelCamera camera = cameraOf(scene, clash);
  std::array<double, 3> eye{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    eye[axis] = (camera.centre[axis] - 2.0 * camera.height * camera.direction[axis]) * metresPerUnit;
  }
  std::string text = kHead;
  text += fmt::format("<VisualizationInfo Guid=\"{}\">\n  <Components>\n    <Selection>\n", viewpointGuid(clash));
  text += component(scene.name(clash.first));
  if (!clash.isSelf()) text += component(scene.name(clash.second));
  text += "    </Selection>\n    <Visibility DefaultVisibility=\"true\"/>\n  </Components>\n  <OrthogonalCamera>\n";
  text += vector("CameraViewPoint", eye) + vector("CameraDirection", camera.direction);
  text += vector("CameraUpVector", camera.up);
  text += fmt::format("    <ViewToWorldScale>{}</ViewToWorldScale>\n", camera.height * metresPerUnit);
  return text + "  </OrthogonalCamera>\n</VisualizationInfo>\n";
}

}  // namespace

std::string makeBcf(const ViewScene& scene, std::span<const Clash> clashes, const BcfOptions& options) {
  Zip archive;
  archive.add("bcf.version",
              std::string(kHead) + "<Version VersionId=\"2.1\"><DetailedVersion>2.1</DetailedVersion></Version>\n");
  for (const Clash& clash : clashes) {
    archive.add(clash.guid + "/markup.bcf", markup(scene, clash, options));
    archive.add(clash.guid + "/viewpoint.bcfv", viewpoint(scene, clash, options.metresPerUnit));
    archive.add(clash.guid + "/snapshot.png", options.picture(clash));
  }
  return archive.finish();
}

}  // namespace allpairs::view
