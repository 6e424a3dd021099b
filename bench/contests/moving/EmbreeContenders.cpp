// SPDX-License-Identifier: MIT
// Embree's rtcCollide on a dynamic scene, committed in each frame: refitted, or rebuilt at low quality.
#include <embree3/rtcore.h>

#include "EmbreeBoxes.h"
#include "MovingSearch.h"

namespace allpairs::bench {

namespace {

struct DeviceDeleter {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};

class EmbreeSteps final : public MovingSearch {
 public:
  EmbreeSteps(RTCDevice device, RTCBuildQuality quality) : m_device(device), m_quality(quality) {}

  void start(const MovingScene& scene) override {
    m_rows = scene.rows().data();
    m_scene.reset(rtcNewScene(m_device));
    rtcSetSceneFlags(m_scene.get(), RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(m_scene.get(), RTC_BUILD_QUALITY_LOW);
    m_geometry = rtcNewGeometry(m_device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(m_geometry, static_cast<unsigned>(scene.rows().size() / 6));
    rtcSetGeometryUserData(m_geometry, this);
    rtcSetGeometryBuildQuality(m_geometry, m_quality);
    rtcSetGeometryBoundsFunction(m_geometry, bounds, nullptr);
    rtcCommitGeometry(m_geometry);
    rtcAttachGeometry(m_scene.get(), m_geometry);
    rtcReleaseGeometry(m_geometry);  // The scene keeps it.
    rtcCommitScene(m_scene.get());
  }

  void step(const MovingScene& scene) override {
    m_rows = scene.rows().data();
    rtcCommitGeometry(m_geometry);
    rtcCommitScene(m_scene.get());
    m_pairs.clear();
    rtcCollide(m_scene.get(), m_scene.get(), report, this);
  }

  void collect(const MovingScene& /*scene*/, std::vector<Pair>& pairs) override { pairs = m_pairs; }

 private:
  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& self = *static_cast<const EmbreeSteps*>(arguments->geometryUserPtr);
    const float* const row = self.m_rows + 6 * std::size_t{arguments->primID};
    writeBounds(row, *arguments->bounds_o);
  }

  /// Embree reports pairs of leaves and leaves the test of the boxes to the callback.
  static void report(void* self, RTCCollision* collisions, unsigned count) {
    auto& search = *static_cast<EmbreeSteps*>(self);
    for (unsigned k = 0; k < count; ++k) {
      const Pair pair{collisions[k].primID0, collisions[k].primID1};
      const float* const a = search.m_rows + 6 * std::size_t{pair.first};
      const float* const b = search.m_rows + 6 * std::size_t{pair.second};
      const bool apart = a[0] > b[3] || b[0] > a[3] || a[1] > b[4] || b[1] > a[4] || a[2] > b[5] || b[2] > a[5];
      if (pair.first < pair.second && !apart) search.m_pairs.push_back(pair);
    }
  }

  RTCDevice m_device;
  RTCBuildQuality m_quality;
  const float* m_rows = nullptr;
  RTCGeometry m_geometry = nullptr;
  std::unique_ptr<RTCSceneTy, SceneDeleter> m_scene;
  std::vector<Pair> m_pairs;
};

}  // namespace

void addEmbreeContenders(std::vector<MovingContender>& contenders) {
  // The settings share the device, which ends with the last of them.
  const std::shared_ptr<RTCDeviceTy> device(rtcNewDevice("threads=1,user_threads=1"), DeviceDeleter());
  const auto add = [&](const char* name, RTCBuildQuality quality) {
    contenders.push_back(
        {"Embree", name, [device, quality] { return std::make_unique<EmbreeSteps>(device.get(), quality); }});
  };
  add("dynamic scene, refitted", RTC_BUILD_QUALITY_REFIT);
  add("dynamic scene, low quality", RTC_BUILD_QUALITY_LOW);
}

}  // namespace allpairs::bench
