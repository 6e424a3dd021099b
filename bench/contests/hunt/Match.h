// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "SceneFamily.h"

namespace allpairs::bench {

/// What one contender took for a scene.
struct Entry {
  std::string name;
  std::string setting;
  double ns = 0.0;           ///< The median; of one that was left out, the estimate that it was left out for.
  bool leftOut = false;      ///< Fewer boxes told that it would take far longer than we do.
  std::string mistake = {};  ///< Empty if its pairs are ours.
};

/// What a match came to: the first entry is overlaps(), the second a kept object's unordered find().
struct MatchResult {
  SceneFamily family;
  double pairs = 0.0;  ///< In a scene, the mean.
  std::vector<Entry> entries;

  /// The fastest of those that were measured besides us and found the same pairs; null if there is none.
  [[nodiscard]] const Entry* best() const;

  /// Its time divided by that of our ordered call, or of our unordered one; infinite without any.
  [[nodiscard]] double orderedRatio() const { return ratioTo(entries[0]); }
  [[nodiscard]] double unorderedRatio() const { return ratioTo(entries[1]); }

 private:
  [[nodiscard]] double ratioTo(const Entry& ours) const;
};

/// How a match is held.
struct MatchOptions {
  std::vector<std::string> peers;  ///< Only these besides us; all if empty.
  double seconds = 0.1;            ///< For the timed turns.
  double carefulSeconds = 0.6;     ///< For a second match, on other boxes, where we seem to lead by little.
  bool all = false;                ///< Measures those too that take far longer, as far as the time allows.
};

/// Measures all contenders on scenes of the family, no two the same, in turns, and compares their pairs.
[[nodiscard]] MatchResult holdMatch(const SceneFamily& family, const MatchOptions& options);

}  // namespace allpairs::bench
