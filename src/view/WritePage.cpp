// SPDX-License-Identifier: MIT
#include "WritePage.h"

#include <string_view>

#include "Base64.h"
#include "PageTemplate.h"
#include "SceneData.h"
#include "allpairs/Error.h"

namespace allpairs::view {

void writePage(const ViewScene& scene, scene::ByteSink sink) {
  constexpr std::string_view kMarker = "<!--ALLPAIRS-SCENE-->";
  const std::string_view page = pageTemplate();
  const std::size_t place = page.find(kMarker);
  if (place == std::string_view::npos) throw Error("the viewer's page has no place for a scene");
  const SceneData data = dataOf(scene);
  sink(page.substr(0, place));
  sink("<script type=\"application/json\" id=\"allpairs-scene\">");
  sink(data.json);
  sink("</script>\n<script type=\"application/octet-stream\" id=\"allpairs-arrays\">");
  writeBase64(data.bytes, sink);
  sink("</script>");
  sink(page.substr(place + kMarker.size()));
}

}  // namespace allpairs::view
