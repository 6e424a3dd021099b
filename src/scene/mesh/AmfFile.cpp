// SPDX-License-Identifier: MIT
#include "mesh/AmfFile.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

/// The unit that the outermost element names; empty where it names none.
std::string_view unitOf(std::string_view xml) {
  const std::size_t begin = xml.find("<amf");
  if (begin == std::string_view::npos) return {};
  const std::string_view tag = xml.substr(begin, xml.find('>', begin) - begin);
  const std::size_t name = tag.find("unit");
  const std::size_t quote = name == std::string_view::npos ? name : tag.find_first_of("\"'", name);
  if (quote == std::string_view::npos) return {};
  const std::string_view value = tag.substr(quote + 1);
  return value.substr(0, value.find(tag[quote]));
}

}  // namespace

double checkedAmfUnit(const std::filesystem::path& path, const ReadScope& scope) {
  static constexpr std::array<std::pair<std::string_view, double>, 6> kUnits{{{"", 0.001},  // what the format says
                                                                              {"millimeter", 0.001},
                                                                              {"micron", 1e-6},
                                                                              {"inch", 0.0254},
                                                                              {"feet", 0.3048},
                                                                              {"meter", 1.0}}};
  const std::string text = readText(path, scope.stop());
  if (text.find("<constellation") != std::string::npos)
    throw FileError(path, "has constellations, which are not read: export each object in its place");
  const std::string unit = lowerCase(unitOf(text));
  const auto known =
      std::find_if(kUnits.begin(), kUnits.end(), [&unit](const auto& entry) { return unit == entry.first; });
  return known == kUnits.end() ? 0.0 : known->second;
}

}  // namespace allpairs::scene
