// SPDX-License-Identifier: MIT
// Embree over one geometry of the user's kind: rtcIntersect1 for rays, rtcPointQuery for the nearest box. The callbacks
// test boxes, in float32.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "EmbreeBoxes.h"
#include "QueryContest.h"

namespace allpairs::bench {
namespace {

struct DeviceDeleter {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};

constexpr float kFar = std::numeric_limits<float>::infinity();

/// When a ray enters a box, infinity if it doesn't within its length.
float entryOf(const RTCRay& ray, const float* row) {
  const std::array<float, 3> origin{ray.org_x, ray.org_y, ray.org_z};
  const std::array<float, 3> inverse{1.0F / ray.dir_x, 1.0F / ray.dir_y, 1.0F / ray.dir_z};
  float enter = 0.0F;
  float leave = ray.tfar;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float a = (row[axis] - origin[axis]) * inverse[axis];
    const float b = (row[axis + 3] - origin[axis]) * inverse[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return kFar;
  return enter;
}

float squareOf(const RTCPointQuery& query, const float* row) {
  const std::array<float, 3> point{query.x, query.y, query.z};
  float squares = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float apart = std::max({row[axis] - point[axis], point[axis] - row[axis + 3], 0.0F});
    squares += apart * apart;
  }
  return squares;
}

class EmbreeIndex final : public QueryIndex {
 public:
  explicit EmbreeIndex(const QueryScene& scene) : m_device(rtcNewDevice("threads=1")), m_rows(scene.rows.data()) {
    m_scene.reset(rtcNewScene(m_device.get()));
    rtcSetSceneBuildQuality(m_scene.get(), RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(m_device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.rows.size() / 6));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, boundsOfBox, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet);
    rtcSetGeometryPointQueryFunction(geometry, approach);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(m_scene.get(), geometry);
    rtcReleaseGeometry(geometry);  // The scene keeps it.
    rtcCommitScene(m_scene.get());
  }

  [[nodiscard]] bool answers(QueryKind kind) const override {
    return kind == QueryKind::FirstHit || kind == QueryKind::AllHits || kind == QueryKind::Nearest1;
  }

  void run(QueryKind kind, const QueryScene& scene) override {
    m_kind = kind;
    m_answers.clear();
    if (kind == QueryKind::Nearest1) {
      for (const auto& point : scene.points) nearest(point);
    } else {
      for (const Ray& ray : scene.rays) trace(ray);
    }
  }

  void collect(Answers& answers) const override { answers = m_answers; }

 private:
  static void boundsOfBox(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const EmbreeIndex*>(arguments->geometryUserPtr);
    const float* const row = self.m_rows + 6 * std::size_t{arguments->primID};
    writeBounds(row, *arguments->bounds_o);
  }

  static void meet(const RTCIntersectFunctionNArguments* arguments) {
    auto& self = *static_cast<EmbreeIndex*>(arguments->geometryUserPtr);
    auto& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    const float entry = entryOf(hit.ray, self.m_rows + 6 * std::size_t{arguments->primID});
    if (entry == kFar) return;
    if (self.m_kind == QueryKind::AllHits) {
      self.m_answers.numbers.push_back(static_cast<double>(entry));
    } else {
      hit.ray.tfar = entry;
      hit.hit.geomID = arguments->geomID;
      hit.hit.primID = arguments->primID;
    }
  }

  static bool approach(RTCPointQueryFunctionArguments* arguments) {
    const auto& self = *static_cast<const EmbreeIndex*>(arguments->userPtr);
    const float square = squareOf(*arguments->query, self.m_rows + 6 * std::size_t{arguments->primID});
    const float radius = std::sqrt(square);
    if (radius >= arguments->query->radius) return false;
    arguments->query->radius = radius;
    return true;
  }

  void trace(const Ray& ray) {
    RTCRayHit hit{};
    hit.ray.org_x = static_cast<float>(ray.origin[0]);
    hit.ray.org_y = static_cast<float>(ray.origin[1]);
    hit.ray.org_z = static_cast<float>(ray.origin[2]);
    hit.ray.dir_x = static_cast<float>(ray.direction[0]);
    hit.ray.dir_y = static_cast<float>(ray.direction[1]);
    hit.ray.dir_z = static_cast<float>(ray.direction[2]);
    hit.ray.tfar = static_cast<float>(ray.length);
    hit.ray.mask = 0xFFFFFFFFU;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    rtcIntersect1(m_scene.get(), &context, &hit);
    if (m_kind == QueryKind::FirstHit) {
      const bool met = hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      m_answers.numbers.push_back(met ? static_cast<double>(hit.ray.tfar) : std::numeric_limits<double>::infinity());
    }
    m_answers.ends.push_back(m_answers.numbers.size());
  }

  void nearest(const std::array<double, 3>& point) {
    RTCPointQuery query{};
    query.x = static_cast<float>(point[0]);
    query.y = static_cast<float>(point[1]);
    query.z = static_cast<float>(point[2]);
    query.radius = kFar;
    RTCPointQueryContext context{};
    rtcInitPointQueryContext(&context);
    rtcPointQuery(m_scene.get(), &query, &context, approach, this);
    m_answers.numbers.push_back(static_cast<double>(query.radius));
    m_answers.ends.push_back(m_answers.numbers.size());
  }

  std::unique_ptr<RTCDeviceTy, DeviceDeleter> m_device;
  std::unique_ptr<RTCSceneTy, SceneDeleter> m_scene;
  const float* m_rows;
  QueryKind m_kind = QueryKind::FirstHit;
  Answers m_answers;
};

}  // namespace

void addEmbreeIndex(const QueryScene& scene, std::vector<QueryContender>& contenders) {
  contenders.push_back({"Embree", "high quality", std::make_unique<EmbreeIndex>(scene)});
}

}  // namespace allpairs::bench
