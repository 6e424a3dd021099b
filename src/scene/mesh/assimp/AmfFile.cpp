// SPDX-License-Identifier: MIT
#include "mesh/assimp/AmfFile.h"

#include <algorithm>
#include <array>
#include <new>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

/// Whether an instance lets its object be where it is, and as it is.
bool leavesInPlace(const pugi::xml_node& instance) {
  const auto isAll = [&instance](const auto& names, double wanted) {
    return std::all_of(names.begin(), names.end(), [&](const char* name) {
      const pugi::xml_node value = instance.child(name);
      return !value || parseNumber(trimmed(value.text().get())).value_or(0.0) == wanted;
    });
  };
  static constexpr std::array<const char*, 6> kMoves{"deltax", "deltay", "deltaz", "rx", "ry", "rz"};
  static constexpr std::array<const char*, 4> kScales{"scale", "scalex", "scaley", "scalez"};  // of PrusaSlicer
  return isAll(kMoves, 0.0) && isAll(kScales, 1.0);
}

}  // namespace

double checkedAmfUnit(const std::filesystem::path& path) {
  static constexpr std::array<std::pair<std::string_view, double>, 6> kUnits{{{"", 0.001},  // what the format says
                                                                              {"millimeter", 0.001},
                                                                              {"micron", 1e-6},
                                                                              {"inch", 0.0254},
                                                                              {"feet", 0.3048},
                                                                              {"meter", 1.0}}};
  const std::string text = readText(path);
  pugi::xml_document document;
  const auto result = document.load_buffer(text.data(), text.size());
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  const pugi::xml_node amf = document.child("amf");
  if (!result || !amf) return 0.0;  // which Assimp refuses
  for (const pugi::xml_node& constellation : amf.children("constellation")) {
    const auto instances = constellation.children("instance");
    if (!std::all_of(instances.begin(), instances.end(), leavesInPlace))
      throw FileError(path, "has constellations, which are not read: export each object in its place");
  }
  const std::string unit = lowerCase(amf.attribute("unit").value());
  const auto known =
      std::find_if(kUnits.begin(), kUnits.end(), [&unit](const auto& entry) { return unit == entry.first; });
  return known == kUnits.end() ? 0.0 : known->second;
}

}  // namespace allpairs::scene
