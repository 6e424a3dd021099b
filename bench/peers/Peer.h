// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Pair.h"

namespace allpairs::bench {

/// One search from boxes in memory to pairs in memory. What it builds on the way lives until it is destroyed, so that
/// taking it down is not part of the time.
class Search {
 public:
  Search() = default;
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;
  Search(Search&&) = delete;
  Search& operator=(Search&&) = delete;
  virtual ~Search() = default;

  /// All pairs of closed boxes that overlap, each once, in any order and orientation; boxes are rows of 6 floats.
  [[nodiscard]] virtual std::span<const Pair> find(std::span<const float> rows) = 0;

  /// How many the last search has found, of one that gives no pairs.
  [[nodiscard]] virtual std::uint64_t count() const noexcept { return 0; }
};

/// One way to set a peer up.
struct Setting {
  std::string name;
  std::function<std::unique_ptr<Search>()> make;
  std::size_t mostBoxes = std::numeric_limits<std::size_t>::max();  ///< More would take it too long.
};

/// A program that answers the same question; it is measured in whichever of its settings is the fastest on the scene.
struct Peer {
  std::string name;
  std::string version;
  std::vector<Setting> settings;
};

/// The peers that this build was made with.
[[nodiscard]] std::vector<Peer> packagedPeers();

/// Whether boxes i and j, rows of 6, overlap: for peers that report more than the overlapping pairs.
[[nodiscard]] inline bool rowsOverlap(const float* rows, std::size_t i, std::size_t j) noexcept {
  const float* const a = rows + 6 * i;
  const float* const b = rows + 6 * j;
  return a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5];
}

// One file each under peers/; those that were left out of the build are not called.
[[nodiscard]] Peer scalarLoopPeer();
[[nodiscard]] Peer nativeLoopPeer();
[[nodiscard]] Peer cgalPeer();
[[nodiscard]] Peer embreePeer();
[[nodiscard]] Peer fclPeer();
[[nodiscard]] Peer bulletPeer();
[[nodiscard]] Peer boostGeometryPeer();

}  // namespace allpairs::bench
