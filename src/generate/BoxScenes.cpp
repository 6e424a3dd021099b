// SPDX-License-Identifier: MIT
#include "allpairs/generate/BoxScenes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "Families.h"
#include "MortonOrder.h"
#include "allpairs/Error.h"

namespace allpairs::generate {

namespace {

using Family = std::vector<float> (*)(std::size_t count, std::uint64_t seed);

constexpr std::array<BoxScene, 7> kScenes{{
    {"uniform", "equal cubes, centres spread evenly over a unit cube; about 2.3 pairs a box"},
    {"clusters", "clouds of about 500 cubes, each cloud of its own size and place; about 3 pairs a box"},
    {"power-law", "cubes of many sizes, P(side > s) ~ 1/s^2 up to a quarter of the whole; about 2 pairs a box"},
    {"city", "blocks on a plane, so flat as a whole and all at the same height; about 3 pairs a box"},
    {"needles", "boxes 10 to 30 times as long as thick, along a random axis; about 4 pairs a box"},
    {"all-overlap", "boxes around one common point: all n(n-1)/2 pairs"},
    {"mesh", "the boxes of the triangles of a wavy torus, shuffled; about 6 pairs a box"},
}};

constexpr std::array<Family, kScenes.size()> kFamilies{uniformBoxes, clusteredBoxes,   powerLawBoxes, cityBoxes,
                                                       needleBoxes,  overlappingBoxes, triangleBoxes};

Family familyOf(std::string_view name) {
  const auto* const scene =
      std::find_if(kScenes.begin(), kScenes.end(), [&](const BoxScene& s) { return s.name == name; });
  if (scene != kScenes.end()) return kFamilies[static_cast<std::size_t>(scene - kScenes.begin())];
  std::string message = std::string("unknown scene '").append(name).append("'; there are");
  for (const BoxScene& known : kScenes) message.append(" ").append(known.name);
  throw InvalidArgument(message);
}

}  // namespace

Span<const BoxScene> boxScenes() noexcept { return kScenes; }

std::vector<float> makeBoxes(const SceneRequest& request) {
  const Family family = familyOf(request.scene);
  if (request.count > std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument("a scene of " + std::to_string(request.count) + " boxes is more than 2^32 - 1");
  }
  std::vector<float> rows = family(request.count, request.seed);
  return request.sorted ? inMortonOrder(rows) : rows;
}

}  // namespace allpairs::generate
