// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "MovingScene.h"
#include "allpairs/Pair.h"

namespace allpairs::bench {

/// A program that keeps boxes and is told when they move.
class MovingSearch {
 public:
  MovingSearch() = default;
  MovingSearch(const MovingSearch&) = delete;
  MovingSearch& operator=(const MovingSearch&) = delete;
  MovingSearch(MovingSearch&&) = delete;
  MovingSearch& operator=(MovingSearch&&) = delete;
  virtual ~MovingSearch() = default;

  /// Takes the boxes of the first frame.
  virtual void start(const MovingScene& scene) = 0;

  /// Takes what moved and finds the pairs; this is what is timed.
  virtual void step(const MovingScene& scene) = 0;

  /// The pairs of the last step, each once, in any order and orientation.
  virtual void collect(const MovingScene& scene, std::vector<Pair>& pairs) = 0;
};

/// One way to keep boxes, and how to start with it.
struct MovingContender {
  std::string name;
  std::string setting;
  std::function<std::unique_ptr<MovingSearch>()> make;
  bool own = false;  ///< Ours: run on all frames. The others are much slower and may be stopped before.
};

/// Ours: the world, and the one-shot search for comparison.
[[nodiscard]] std::vector<MovingContender> ownContenders();

/// The peers that this build was made with.
[[nodiscard]] std::vector<MovingContender> peerContenders();

// One file each; those that were left out of the build are not called.
void addBulletContenders(std::vector<MovingContender>& contenders);
void addFclContenders(std::vector<MovingContender>& contenders);
void addEmbreeContenders(std::vector<MovingContender>& contenders);
void addPhysxContenders(std::vector<MovingContender>& contenders);
void addJoltContenders(std::vector<MovingContender>& contenders);

}  // namespace allpairs::bench
