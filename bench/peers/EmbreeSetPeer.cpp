// SPDX-License-Identifier: MIT
// Embree's rtcCollide between two scenes. It leaves the test of the boxes to the callback.
#include <embree3/rtcore.h>

#include "EmbreeBoxes.h"
#include "SetPeer.h"

namespace allpairs::bench {

namespace {

struct SceneEnd {
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};
using EmbreeScene = std::unique_ptr<RTCSceneTy, SceneEnd>;

void boundsOfRow(const RTCBoundsFunctionArguments* arguments) {
  const float* const row = static_cast<const float*>(arguments->geometryUserPtr) + 6 * std::size_t{arguments->primID};
  writeBounds(row, *arguments->bounds_o);
}

class EmbreeOfTwoSets final : public SetSearch<float> {
 public:
  EmbreeOfTwoSets(std::shared_ptr<RTCDeviceTy> device, RTCBuildQuality quality)
      : m_device(std::move(device)), m_quality(quality) {}

  std::span<const Pair> find(const Sets<float>& sets) override {
    clear();
    m_sets = sets;
    m_first = sceneOf(sets.first);
    m_second = sceneOf(sets.second);
    rtcCollide(m_first.get(), m_second.get(), report, this);
    return m_pairs;
  }

  void clear() override {
    m_first.reset();
    m_second.reset();
    m_pairs = {};
  }

 private:
  EmbreeScene sceneOf(std::span<const float> rows) {
    EmbreeScene scene(rtcNewScene(m_device.get()));
    rtcSetSceneBuildQuality(scene.get(), m_quality);
    RTCGeometry geometry = rtcNewGeometry(m_device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(rows.size() / 6));
    rtcSetGeometryUserData(geometry, const_cast<float*>(rows.data()));  // Read only, in boundsOfRow.
    rtcSetGeometryBuildQuality(geometry, m_quality);
    rtcSetGeometryBoundsFunction(geometry, boundsOfRow, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
  }

  static void report(void* self, RTCCollision* collisions, unsigned count) {
    auto& search = *static_cast<EmbreeOfTwoSets*>(self);
    for (unsigned k = 0; k < count; ++k) {
      const Pair pair{collisions[k].primID0, collisions[k].primID1};
      const float* const first = search.m_sets.first.data() + 6 * std::size_t{pair.first};
      if (boxesOverlap(first, search.m_sets.second.data() + 6 * std::size_t{pair.second}))
        search.m_pairs.push_back(pair);
    }
  }

  std::shared_ptr<RTCDeviceTy> m_device;
  RTCBuildQuality m_quality;
  Sets<float> m_sets;
  EmbreeScene m_first;
  EmbreeScene m_second;
  std::vector<Pair> m_pairs;
};

}  // namespace

SetPeer<float> embreeOfTwoSets() {
  // The settings share the device, which ends with the last of them.
  const std::shared_ptr<RTCDeviceTy> device(rtcNewDevice("threads=1,user_threads=1"), rtcReleaseDevice);
  return {"Embree",
          {{"low quality", [=] { return std::make_unique<EmbreeOfTwoSets>(device, RTC_BUILD_QUALITY_LOW); }},
           {"medium quality", [=] { return std::make_unique<EmbreeOfTwoSets>(device, RTC_BUILD_QUALITY_MEDIUM); }}}};
}

}  // namespace allpairs::bench
