// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Pair.h"

namespace allpairs::bench {

/// The boxes of one set or of two, rows of 6.
template <class T>
struct Sets {
  std::span<const T> first;
  std::span<const T> second;  ///< Not used of one set.
  bool areTwo = false;

  [[nodiscard]] std::size_t boxes() const noexcept { return (first.size() + second.size()) / 6; }
};

/// Finds the pairs of boxes in memory, in memory. It can be used again; each search starts from nothing.
template <class T>
class SetSearch {
 public:
  SetSearch() = default;
  SetSearch(const SetSearch&) = delete;
  SetSearch& operator=(const SetSearch&) = delete;
  SetSearch(SetSearch&&) = delete;
  SetSearch& operator=(SetSearch&&) = delete;
  virtual ~SetSearch() = default;

  /// All pairs of closed boxes that overlap, each once, in any order: of two sets, a box of the first and one of the
  /// second; of one set, in any orientation. Valid until the next call.
  [[nodiscard]] virtual std::span<const Pair> find(const Sets<T>& sets) = 0;

  /// Takes down what the last search has built and found, as the next one would.
  virtual void clear() = 0;
};

/// One way to set a peer up.
template <class T>
struct SetSetting {
  std::string name;
  std::function<std::unique_ptr<SetSearch<T>>()> make;
};

/// A program that answers the same question; it is measured in whichever of its settings is the fastest.
template <class T>
struct SetPeer {
  std::string name;
  std::vector<SetSetting<T>> settings;
};

/// The plain loop, the plain sweep and the peers of this build that search float32 or float64, one set or two.
template <class T>
[[nodiscard]] std::vector<SetPeer<T>> setPeers(bool areTwo);

/// Whether two boxes, rows of 6, overlap.
template <class T>
[[nodiscard]] inline bool boxesOverlap(const T* a, const T* b) noexcept {
  return a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5];
}

// Of files in this folder; those that were left out of the build are not called.
template <class T>
[[nodiscard]] SetPeer<T> plainLoopOfSets();
template <class T>
[[nodiscard]] SetPeer<T> plainSweepOfSets();
template <class T>
[[nodiscard]] SetPeer<T> cgalOfSets();
template <class T>
[[nodiscard]] SetPeer<T> boostGeometryOfSets();
template <class T>
[[nodiscard]] SetPeer<T> fclOfSets();
template <class T>
[[nodiscard]] SetPeer<T> bvhOfSets();
template <class T>
[[nodiscard]] SetPeer<T> arborxOfSets();
[[nodiscard]] SetPeer<float> embreeOfTwoSets();
[[nodiscard]] SetPeer<float> bulletOfTwoSets();
[[nodiscard]] SetPeer<float> physxOfSets();
[[nodiscard]] SetPeer<float> tinyBvhOfSets();

}  // namespace allpairs::bench
