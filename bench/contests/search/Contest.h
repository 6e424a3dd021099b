// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "OwnSearches.h"
#include "Peer.h"
#include "Sampling.h"

namespace allpairs::bench {

/// One of those that are measured against each other.
struct Contender {
  std::string name;
  std::string setting;
  std::size_t threads = 1;
  MakeSearch make;
  bool givesPairs = true;  ///< False for one that only counts; its count is compared.
};

/// What one contender did on one scene.
struct Outcome {
  measure::Summary times;
  std::uint64_t pairs = 0;  ///< In the first set.
  std::string hash;         ///< Of the pairs in order; see measure::hashOfPairs. Empty for one that gives no pairs.
  std::string mistake;      ///< How its pairs differ from the first contender's; empty if they don't.
};

/// Sets of boxes from the same distribution, each as rows of 6.
using BoxSets = std::vector<std::vector<float>>;

/// Measures all contenders on the same boxes, interleaved, so that other load on the machine affects them equally. They
/// take the sets one after the other: a processor learns the branches of a small set that it sees again.
///
/// On every set each runs once before, untimed as far as the result goes, and its pairs are compared whole with the
/// first contender's; of one that only counts, or beside a first one that does, the counts are.
[[nodiscard]] std::vector<Outcome> contest(std::span<const Contender> contenders, const BoxSets& sets,
                                           const measure::Effort& effort);

/// The setting in which the peer is the fastest on these boxes: each is tried, slow ones once and fast ones thrice;
/// null if there are too many boxes for all of them.
[[nodiscard]] const Setting* fastestSetting(const Peer& peer, std::span<const float> rows);

}  // namespace allpairs::bench
