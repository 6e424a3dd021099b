// SPDX-License-Identifier: MIT
// What anybody writes first: two loops over an array of boxes, compiled as the project's release is.
#include "Peer.h"

namespace allpairs::bench {

namespace {

class ScalarLoop final : public Search {
 public:
  std::span<const Pair> find(std::span<const float> rows) override {
    const auto count = static_cast<std::uint32_t>(rows.size() / 6);
    for (std::uint32_t i = 0; i < count; ++i) {
      for (std::uint32_t j = i + 1; j < count; ++j) {
        if (rowsOverlap(rows.data(), i, j)) m_pairs.push_back({i, j});
      }
    }
    return m_pairs;
  }

 private:
  std::vector<Pair> m_pairs;
};

}  // namespace

Peer scalarLoopPeer() {
  constexpr std::size_t kMostBoxes = 10000;
  return {.name = "scalar loop",
          .version = "",
          .settings = {{"array of boxes", [] { return std::make_unique<ScalarLoop>(); }, kMostBoxes}}};
}

}  // namespace allpairs::bench
