// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ModelTable.h"
#include "allpairs/Executor.h"
#include "allpairs/Pair.h"
#include "allpairs/World.h"

namespace allpairs::collision {

/// A search of all rows of a table that is kept from step to step: what it costs follows which rows' boxes changed.
///
/// Which model is in a row plays no part, since the rules are asked about every pair in every step. When it is worth
/// its cost, and why, is in docs/decisions/0013.
class KeptSearch {
 public:
  /// What the pairs depend on besides the boxes.
  struct Settings {
    double distance = 0.0;
    bool addsContactDistances = false;
    Executor* executor = nullptr;
    const StopFlag* stop = nullptr;

    friend bool operator==(const Settings&, const Settings&) = default;
  };

  /// Looks at the rows of a step; returns whether this search is the one to ask for their pairs.
  [[nodiscard]] bool isWorthIt(const ModelTable& models, const Settings& settings);

  /// The pairs of (older, newer) rows, ordered by the newer one. The step was looked at, and was worth it.
  [[nodiscard]] std::span<const Pair> find(const ModelTable& models);

  /// How many pairs another search has found in the step that was looked at.
  void notePairs(std::size_t pairs) { m_pairCount = pairs; }

  /// Tests that the last call of find() made.
  [[nodiscard]] std::uint64_t testsMade() const { return m_testsMade; }

 private:
  [[nodiscard]] BoxId idOf(std::size_t row) const { return m_lastId - static_cast<BoxId>(row); }
  [[nodiscard]] bool hasLastStepOf(const ModelTable& models) const;
  void makeWorld(const ModelTable& models);
  void moveAll(const ModelTable& models);
  void moveChanged(const ModelTable& models);
  void startMoving();
  void place(const ModelTable& models, std::size_t row);
  void vacate(std::size_t begin, std::size_t end);
  void move();
  void step();

  Settings m_settings;           // of the step that was looked at
  std::uint64_t m_lookedAt = 0;  // the number of that step
  std::size_t m_quietSteps = 0;  // how many of few changes there were in a row
  std::size_t m_pairCount = 0;
  std::uint64_t m_testsMade = 0;

  // The box of a row has an id that is the less, the higher the row: World orders pairs by the lesser of their ids, and
  // read backwards that is the order of the newer row. Ids beyond the rows have empty boxes.
  std::optional<World> m_world;
  Settings m_worldSettings;
  std::uint64_t m_worldStep = 0;  // the number of the step whose boxes it has
  std::size_t m_worldRows = 0;    // how many of them there were
  std::size_t m_room = 0;         // for how many rows it has ids
  BoxId m_lastId = 0;
  std::vector<BoxId> m_ids;  // what is to be moved
  std::vector<Box> m_boxes;
  std::vector<BoxProperties> m_properties;
  std::vector<Pair> m_pairs;
};

}  // namespace allpairs::collision
