// SPDX-License-Identifier: MIT
#include "SceneData.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "Base64.h"
#include "ClashPicture.h"
#include "PageSize.h"
#include "VectorMath.h"

namespace allpairs::view {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "the page reads its arrays as little-endian");

/// Arrays one after the other, each at a multiple of eight bytes, and the list that says where.
class ArrayWriter {
 public:
  template <class T>
  void add(const char* name, const char* type, std::span<const T> values) {
    m_list.push_back({{"name", name}, {"type", type}, {"offset", m_bytes.size()}, {"length", values.size()}});
    if (!values.empty()) {
      const std::size_t offset = m_bytes.size();
      m_bytes.resize(offset + values.size_bytes());
      std::memcpy(m_bytes.data() + offset, values.data(), values.size_bytes());
    }
    m_bytes.resize((m_bytes.size() + 7) / 8 * 8);
  }

  void add(const char* name, const std::vector<double>& values) { add<double>(name, "Float64", values); }
  void add(const char* name, const std::vector<float>& values) { add<float>(name, "Float32", values); }
  void add(const char* name, const std::vector<std::uint32_t>& values) { add<std::uint32_t>(name, "Uint32", values); }
  void add(const char* name, const std::vector<std::uint8_t>& values) { add<std::uint8_t>(name, "Uint8", values); }

  [[nodiscard]] Json list() { return std::move(m_list); }
  [[nodiscard]] std::string bytes() { return std::move(m_bytes); }

 private:
  Json m_list = Json::array();
  std::string m_bytes;
};

void append(std::vector<double>& numbers, const Box& box) {
  numbers.insert(numbers.end(), box.min.begin(), box.min.end());
  numbers.insert(numbers.end(), box.max.begin(), box.max.end());
}

void append(std::vector<double>& numbers, const std::vector<Box>& boxes) {
  for (const Box& box : boxes) append(numbers, box);
}

void append(std::vector<std::uint32_t>& numbers, const std::vector<Pair>& pairs) {
  for (const auto& [first, second] : pairs) numbers.insert(numbers.end(), {first, second});
}

/// The middle of all that is finite: what coordinates are taken from before they become float32 for the graphics.
std::vector<double> originOf(const ViewScene& scene) {
  Box whole = kEmptyBox;
  for (const Box& box : scene.frames.front().boxes) {
    Box finite = box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) finite = kEmptyBox;
    }
    whole = merge(whole, finite);
  }
  if (isEmpty(whole)) return {0.0, 0.0, 0.0};
  std::vector<double> origin;
  for (std::size_t axis = 0; axis < 3; ++axis) origin.push_back(whole.min[axis] / 2 + whole.max[axis] / 2);
  return origin;
}

void addMesh(const ViewMesh& mesh, const std::vector<double>& origin, ArrayWriter& arrays) {
  std::vector<float> vertices;
  vertices.reserve(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    vertices.push_back(static_cast<float>(mesh.vertices[i] - origin[i % 3]));
  }
  arrays.add("vertices", vertices);
  arrays.add("triangles", mesh.triangles);
  arrays.add("triangleEnds", mesh.triangleEnds);
  arrays.add("lines", mesh.lines);
  arrays.add("lineEnds", mesh.lineEnds);
  arrays.add("points", mesh.points);
  arrays.add("pointEnds", mesh.pointEnds);
}

/// How many pairs begin and end in each frame.
void addChanges(const ViewScene& scene, ArrayWriter& arrays) {
  std::vector<std::uint32_t> began;
  std::vector<std::uint32_t> ended;
  for (const ViewFrame& frame : scene.frames) {
    began.push_back(static_cast<std::uint32_t>(frame.began));
    ended.push_back(static_cast<std::uint32_t>(frame.ended));
  }
  arrays.add("began", began);
  arrays.add("ended", ended);
}

void addFrames(const ViewScene& scene, ArrayWriter& arrays) {
  std::vector<double> boxes;
  std::vector<std::uint8_t> flags;
  std::vector<std::uint32_t> pairs;
  std::vector<std::uint32_t> pairEnds;
  std::vector<std::uint32_t> excluded;
  std::vector<std::uint32_t> excludedEnds;
  for (const ViewFrame& frame : scene.frames) {
    if (frame.positions.empty()) append(boxes, frame.boxes);
    flags.insert(flags.end(), frame.flags.begin(), frame.flags.end());
    append(pairs, frame.pairs);
    append(excluded, frame.excluded);
    pairEnds.push_back(static_cast<std::uint32_t>(pairs.size() / 2));
    excludedEnds.push_back(static_cast<std::uint32_t>(excluded.size() / 2));
  }
  arrays.add("boxes", boxes);
  arrays.add("flags", flags);
  arrays.add("pairs", pairs);
  arrays.add("pairEnds", pairEnds);
  arrays.add("excluded", excluded);
  arrays.add("excludedEnds", excludedEnds);
  addChanges(scene, arrays);
}

/// Where the vertices of a sequence of meshes are, frame by frame: in float32 where that holds them exactly.
void addPositions(const ViewScene& scene, ArrayWriter& arrays) {
  std::vector<double> positions;
  for (const ViewFrame& frame : scene.frames) {
    positions.insert(positions.end(), frame.positions.begin(), frame.positions.end());
  }
  if (areFloats(positions)) {
    arrays.add("positions", std::vector<float>(positions.begin(), positions.end()));
  } else {
    arrays.add("positions", positions);
  }
  arrays.add("corners", scene.corners);
}

/// From where the contacts are seen best for which that was chosen: directions, three numbers a pair, all zero for others.
std::vector<float> viewsOf(const ViewScene& scene) {
  std::vector<float> views(3 * scene.exact.size(), 0.0F);
  for (std::size_t i = 0; i < scene.sides.size(); ++i) {
    if (!hasSide(scene, i)) continue;
    const Vec3 direction = cameraOf(scene, clashOf(scene, i)).direction;
    for (std::size_t axis = 0; axis < 3; ++axis) views[3 * i + axis] = static_cast<float>(direction[axis]);
  }
  return views;
}

/// What shapes say of each pair: its state, which model is open, 17 numbers, and where surfaces cross.
void addExact(const ViewScene& scene, const std::vector<double>& origin, ArrayWriter& arrays) {
  std::vector<std::uint8_t> states;
  std::vector<double> numbers;
  std::vector<float> lines;
  std::vector<std::uint32_t> lineEnds;
  for (const ExactPair& pair : scene.exact) {
    states.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(pair.state) | (pair.isFirstOpen ? 16U : 0U) |
                                               (pair.isSecondOpen ? 32U : 0U)));
    numbers.insert(numbers.end(), {pair.distance, pair.depth.value_or(std::numeric_limits<double>::quiet_NaN())});
    for (const auto* vector : {&pair.pointOnFirst, &pair.pointOnSecond, &pair.normal})
      numbers.insert(numbers.end(), vector->begin(), vector->end());
    append(numbers, pair.contactBox);
    for (const auto& line : pair.contactLines) {
      for (const auto& end : line) {
        for (std::size_t axis = 0; axis < 3; ++axis) lines.push_back(static_cast<float>(end[axis] - origin[axis]));
      }
    }
    lineEnds.push_back(static_cast<std::uint32_t>(lines.size() / 6));
  }
  arrays.add("exactStates", states);
  arrays.add("exactNumbers", numbers);
  arrays.add("contactLines", lines);
  arrays.add("contactLineEnds", lineEnds);
  arrays.add("exactViews", viewsOf(scene));
}

void addModels(const ViewScene& scene, ArrayWriter& arrays) {
  arrays.add("types", scene.types);
  arrays.add("groups", scene.groups);
  arrays.add("owners", scene.owners);
  arrays.add("bodies", scene.bodies);
  arrays.add("elements", scene.elements);
  arrays.add("contactDistances", scene.contactDistances);
}

Json statisticsOf(const ViewScene& scene) {
  const scene::DetectionStatistics& from = scene.statistics;
  return {{"strategy", from.strategy},       {"threads", from.threads},
          {"verified", from.verified},       {"testsOfAllPairs", from.testsOfAllPairs},
          {"testsMade", from.testsMade},     {"candidates", from.candidates},
          {"readSeconds", from.readSeconds}, {"detectSeconds", from.detectSeconds}};
}

Json ignoredOf(const ViewScene& scene) {
  Json list = Json::array();
  for (const scene::Remark& remark : scene.ignored) {
    list.push_back({{"file", remark.file.filename().string()},
                    {"line", remark.line},
                    {"subject", remark.subject},
                    {"reason", remark.reason}});
  }
  return list;
}

/// JSON that an HTML parser takes for text to its end: it has no "<", which would begin "</script" or "<!--".
std::string scriptSafe(const Json& json) {
  std::string result;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

SceneData::SceneData(const ViewScene& scene) {
  ArrayWriter arrays;
  const std::vector<double> origin = originOf(scene);
  std::vector<double> region;
  if (scene.region) append(region, *scene.region);
  arrays.add("distance", std::vector<double>{scene.distance});
  arrays.add("region", region);
  arrays.add("origin", origin);
  addModels(scene, arrays);
  addExact(scene, origin, arrays);
  addFrames(scene, arrays);
  addMesh(scene.mesh, origin, arrays);
  addPositions(scene, arrays);
  Json json{{"format", 1},
            {"version", ALLPAIRS_VERSION},
            {"title", scene.title},
            {"method", scene.method},
            {"addsContactDistances", scene.addsContactDistances},
            {"models", scene.modelCount},
            {"isExact", scene.isExact},
            {"exactSeconds", scene.exactSeconds},
            {"clearance", scene.clearance},
            {"up", scene.up},
            {"frames", scene.frames.size()},
            {"meshIsShortened", scene.mesh.isShortened},
            {"names", scene.names},
            {"bodyNames", scene.bodyNames},
            {"kinds", scene.kinds},
            {"ids", scene.ids},
            {"typeNames", scene.typeNames},
            {"groupSets", scene.groupSets},
            {"statistics", statisticsOf(scene)},
            {"ignored", ignoredOf(scene)},
            {"arrays", arrays.list()}};
  m_json = scriptSafe(json);
  m_bytes = arrays.bytes();
  checkPageSize(scene, m_json.size() + m_bytes.size());
}

void SceneData::writeBase64(scene::ByteSink sink) const { view::writeBase64(m_bytes, sink); }

}  // namespace allpairs::view
