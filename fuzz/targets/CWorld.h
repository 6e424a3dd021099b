// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "CSearch.h"

namespace allpairs::fuzz {

/// The numbers of worlds that boxes have here.
inline constexpr std::array<std::uint32_t, 4> kNumbers{0, 1, 7, ALLPAIRS_EVERY_WORLD};

/// Each pair of a step is of one world, or of every world.
inline void compareResults(allpairs_world* world, const allpairs_step& step) {
  std::array<std::size_t, 4> sums{};  // of pairs, began, persisted, ended
  for (const std::uint32_t number : kNumbers) {
    allpairs_step result{};
    require(checked(allpairs_world_result_of(world, number, &result)) == ALLPAIRS_OK, "each world has a result");
    const std::array counts{result.pairs.count, result.began.count, result.persisted.count, result.ended.count};
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += counts[i];
  }
  require(sums[0] == step.pairs.count && sums[1] + sums[2] == sums[0], "each pair of a step is of one world");
  require(sums[1] - step.began.count == sums[3] - step.ended.count, "what changes its world ends there, begins here");
}

/// What is added is there, and all of it or nothing.
inline void requireAdded(const allpairs_world* world, std::size_t before, const std::vector<std::uint32_t>& ids,
                         allpairs_status status) {
  const bool isDone = status == ALLPAIRS_OK;
  require(allpairs_world_size(world) == before + (isDone ? ids.size() : 0), "boxes are added all or not at all");
  for (const std::uint32_t id : ids) require(!isDone || allpairs_world_contains(world, id), "what was added is there");
}

/// Boxes that are added with these properties.
inline void addEach(allpairs_world* world, const allpairs_set* set, const allpairs_properties& properties) {
  const std::size_t before = allpairs_world_size(world);
  const std::vector<allpairs_properties> each(allpairs_set_size(set), properties);
  std::vector<std::uint32_t> ids(each.size());
  requireAdded(world, before, ids, checked(allpairs_world_add_each(world, set, each.data(), ids.data())));
}

/// The statistics of the last step, as far as the caller knows such a structure.
inline allpairs_step_statistics statisticsOf(const allpairs_world* world, std::size_t known) {
  allpairs_step_statistics statistics{};
  statistics.struct_size = known;
  statistics.joined_all = true;
  const allpairs_status status = checked(allpairs_world_statistics(world, &statistics));
  const bool isFine = world != nullptr && known >= sizeof known && known <= sizeof statistics && known % 8 == 0;
  require((status == ALLPAIRS_OK) == isFine, "statistics are given to whoever knows their structure");
  require(statistics.struct_size == known && (known == sizeof statistics || statistics.joined_all),
          "nothing is written beside what is known");
  return statistics;
}

/// A step gives what it would without statistics, and these say what it was about.
inline void checkStatistics(allpairs_world* world, std::size_t known) {
  static_cast<void>(statisticsOf(world, known));
  if (world == nullptr) return;
  allpairs_step step{};
  require(checked(allpairs_world_step(world, &step)) == ALLPAIRS_OK, "a step succeeds");
  require(checked(allpairs_world_step(world, &step)) == ALLPAIRS_OK, "so does the next one");
  require(step.began.count == 0 && step.ended.count == 0, "in which nothing changes");
  require(statisticsOf(world, sizeof(allpairs_step_statistics)).changed == 0, "which the statistics say");
}

/// Memory for more boxes changes no box.
inline void reserve(allpairs_world* world, std::size_t boxes) {
  const std::size_t size = allpairs_world_size(world);
  const std::uint32_t bound = allpairs_world_id_bound(world);
  const allpairs_status status = checked(allpairs_world_reserve(world, boxes));
  require((status == ALLPAIRS_OK) == (world != nullptr && boxes < ALLPAIRS_NO_BOX), "so many boxes are possible");
  require(allpairs_world_size(world) == size && allpairs_world_id_bound(world) == bound, "no box is added");
  require(!allpairs_world_contains(world, bound), "all ids are below their bound");
}

inline bool always(void* context) {
  ++*static_cast<std::size_t*>(context);
  return true;
}

/// What is stopped gives no result, and what then is not gives the right one.
inline void stopSearch(const CSearch& search, allpairs_options options) {
  std::size_t asked = 0;
  Seen seen;
  options.threads = 0;
  options.stop = always;
  options.stop_context = &asked;
  if (checked(allpairs_search_set_options(search.search, &options)) != ALLPAIRS_OK) return;
  const allpairs_status stopped = search.stream({see, &seen, 0});
  require((stopped == ALLPAIRS_STOPPED) == (asked != 0), "a search ends where it is told to");
  options.stop = nullptr;
  require(checked(allpairs_search_set_options(search.search, &options)) == ALLPAIRS_OK, "the same without a stop");
  search.compareAll(0, false);
}

}  // namespace allpairs::fuzz
