// SPDX-License-Identifier: MIT
// Embree's rtcCollide on one geometry of the user's kind. Devices are made once, as a thread pool is, outside of the
// time. Embree reports pairs of leaves and leaves the test of the boxes to the callback.
#include <embree3/rtcore.h>

#include "EmbreeBoxes.h"
#include "Peer.h"

namespace allpairs::bench {

namespace {

struct DeviceDeleter {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;

struct SceneDeleter {
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};

struct EmbreeSetting {
  const char* name;
  RTCBuildQuality quality;
  RTCSceneFlags flags;
};

void boundsOfBox(const RTCBoundsFunctionArguments* arguments) {
  const float* const row = static_cast<const float*>(arguments->geometryUserPtr) + 6 * std::size_t{arguments->primID};
  writeBounds(row, *arguments->bounds_o);
}

class EmbreeSearch final : public Search {
 public:
  EmbreeSearch(RTCDevice device, const EmbreeSetting& setting) : m_device(device), m_setting(setting) {}

  std::span<const Pair> find(std::span<const float> rows) override {
    m_rows = rows.data();
    m_scene.reset(rtcNewScene(m_device));
    rtcSetSceneFlags(m_scene.get(), m_setting.flags);
    rtcSetSceneBuildQuality(m_scene.get(), m_setting.quality);
    attachBoxes(rows);
    rtcCommitScene(m_scene.get());
    rtcCollide(m_scene.get(), m_scene.get(), report, this);
    return m_pairs;
  }

 private:
  void attachBoxes(std::span<const float> rows) {
    RTCGeometry geometry = rtcNewGeometry(m_device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(rows.size() / 6));
    rtcSetGeometryUserData(geometry, const_cast<float*>(rows.data()));  // Read only, in boundsOfBox.
    rtcSetGeometryBuildQuality(geometry, m_setting.quality);
    rtcSetGeometryBoundsFunction(geometry, boundsOfBox, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(m_scene.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  static void report(void* self, RTCCollision* collisions, unsigned count) {
    auto& search = *static_cast<EmbreeSearch*>(self);
    for (unsigned k = 0; k < count; ++k) {
      const Pair pair{collisions[k].primID0, collisions[k].primID1};
      if (pair.first < pair.second && rowsOverlap(search.m_rows, pair.first, pair.second))
        search.m_pairs.push_back(pair);
    }
  }

  RTCDevice m_device;
  EmbreeSetting m_setting;
  const float* m_rows = nullptr;
  std::unique_ptr<RTCSceneTy, SceneDeleter> m_scene;
  std::vector<Pair> m_pairs;
};

constexpr EmbreeSetting kSettings[] = {
    {"low quality, dynamic scene", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_DYNAMIC},
    {"low quality", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_NONE},
    {"medium quality", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE},
};

}  // namespace

Peer embreePeer() {
  // The settings share the device, which ends with the last of them.
  const std::shared_ptr<RTCDeviceTy> device = Device(rtcNewDevice("threads=1,user_threads=1"));
  Peer peer{.name = "Embree", .version = RTC_VERSION_STRING, .settings = {}};
  for (const EmbreeSetting& setting : kSettings) {
    peer.settings.push_back(
        {setting.name, [device, setting] { return std::make_unique<EmbreeSearch>(device.get(), setting); }});
  }
  return peer;
}

}  // namespace allpairs::bench
