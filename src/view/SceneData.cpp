// SPDX-License-Identifier: MIT
#include "SceneData.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>

#include "ClashPicture.h"
#include "JsonText.h"
#include "PageSize.h"
#include "VectorMath.h"

namespace allpairs::view {
namespace {

static_assert(std::endian::native == std::endian::little, "the page reads its arrays as little-endian");

/// Arrays one after the other, each at a multiple of eight bytes, and the list that says where.
class ArrayWriter {
 public:
  template <class T>
  void add(const char* name, const char* type, std::span<const T> values) {
    m_list.push_back({name, type, m_bytes.size(), values.size()});
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

  void addListTo(JsonText& json) const {
    json.beginList("arrays");
    for (const Entry& entry : m_list) {
      json.beginObject();
      json.add("name", entry.name);
      json.add("type", entry.type);
      json.add("offset", entry.offset);
      json.add("length", entry.length);
      json.endObject();
    }
    json.endList();
  }

  [[nodiscard]] std::string bytes() { return std::move(m_bytes); }

 private:
  struct Entry {
    const char* name;
    const char* type;
    std::size_t offset;
    std::size_t length;
  };

  std::vector<Entry> m_list;
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

/// From where the contacts are seen best for which that was chosen: directions, three numbers a pair, all zero for
/// others.
std::vector<float> viewsOf(const ViewScene& scene) {
  std::vector<float> views(3 * scene.exact.size(), 0.0F);
  for (std::size_t i = 0; i < scene.sides.size(); ++i) {
    if (!hasSide(scene, i)) continue;
    const Vec3 direction = cameraOf(scene, clashOf(scene, i)).direction;
    for (std::size_t axis = 0; axis < 3; ++axis) views[3 * i + axis] = static_cast<float>(direction[axis]);
  }
  return views;
}

/// What shapes say of each pair: its state, which model is open or inside, 17 numbers, and where surfaces cross.
void addExact(const ViewScene& scene, const std::vector<double>& origin, ArrayWriter& arrays) {
  std::vector<std::uint8_t> states;
  std::vector<double> numbers;
  std::vector<float> lines;
  std::vector<std::uint32_t> lineEnds;
  for (const ExactPair& pair : scene.exact) {
    states.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(pair.state) | (pair.isFirstOpen ? 16U : 0U) |
                                               (pair.isSecondOpen ? 32U : 0U) | (pair.isFirstInner ? 64U : 0U)));
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

void addStatistics(const scene::DetectionStatistics& from, JsonText& json) {
  json.beginObject("statistics");
  json.add("strategy", from.strategy);
  json.add("threads", from.threads);
  json.add("verified", from.verified);
  json.add("testsOfAllPairs", from.testsOfAllPairs);
  json.add("testsMade", from.testsMade);
  json.add("candidates", from.candidates);
  json.add("readSeconds", from.readSeconds);
  json.add("detectSeconds", from.detectSeconds);
  json.endObject();
}

void addIgnored(const std::vector<scene::Remark>& remarks, JsonText& json) {
  json.beginList("ignored");
  for (const scene::Remark& remark : remarks) {
    json.beginObject();
    json.add("file", remark.file.filename().string());
    json.add("line", remark.line);
    json.add("subject", remark.subject);
    json.add("reason", remark.reason);
    json.endObject();
  }
  json.endList();
}

void addList(const char* key, const std::vector<std::string>& texts, JsonText& json) {
  json.beginList(key);
  for (const std::string& text : texts) json.add({}, text);
  json.endList();
}

void addGroupSets(const ViewScene& scene, JsonText& json) {
  json.beginList("groupSets");
  for (const std::vector<int>& groups : scene.groupSets) {
    json.beginList();
    for (const int group : groups) json.add({}, group);
    json.endList();
  }
  json.endList();
}

/// All but the arrays.
void addScene(const ViewScene& scene, JsonText& json) {
  json.add("format", 1);
  json.add("version", ALLPAIRS_VERSION);
  json.add("title", scene.title);
  json.add("method", scene.method);
  json.add("addsContactDistances", scene.addsContactDistances);
  json.add("models", scene.modelCount);
  json.add("isExact", scene.isExact);
  json.add("exactSeconds", scene.exactSeconds);
  json.add("clearance", scene.clearance);
  json.add("up", scene.up);
  json.add("frames", scene.frames.size());
  json.add("meshIsShortened", scene.mesh.isShortened);
  json.add("leavesOutExcluded", scene.leavesOutExcluded);
  addList("names", scene.names, json);
  addList("bodyNames", scene.bodyNames, json);
  addList("kinds", scene.kinds, json);
  addList("ids", scene.ids, json);
  addList("typeNames", scene.typeNames, json);
  addGroupSets(scene, json);
  addStatistics(scene.statistics, json);
  addIgnored(scene.ignored, json);
}

/// JSON that an HTML parser takes for text to its end: it has no "<", which would begin "</script" or "<!--".
std::string scriptSafe(const std::string& json) {
  std::string result;
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

SceneData dataOf(const ViewScene& scene) {
  std::size_t least = 0;  // a scene that is too large anyway is not copied first
  for (const ViewFrame& frame : scene.frames) least += bytesOf(frame, frame.pairs.size() + frame.excluded.size());
  checkPageSize(scene, scene.frames.size(), least);
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
  JsonText json(JsonText::Layout::Compact);
  json.beginObject();
  addScene(scene, json);
  arrays.addListTo(json);
  json.endObject();
  SceneData data{scriptSafe(json.text()), arrays.bytes()};
  checkPageSize(scene, scene.frames.size(), data.json.size() + data.bytes.size());
  return data;
}

}  // namespace allpairs::view
