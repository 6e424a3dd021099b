// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "../Target.h"
#include "allpairs.h"

namespace allpairs::fuzz {

inline bool isPair(const allpairs_pair& a, const allpairs_pair& b) {
  return a.first == b.first && a.second == b.second;
}

/// Passes a status on, after a look at what it promises.
inline allpairs_status checked(allpairs_status status) {
  require(status != ALLPAIRS_INTERNAL, "no call fails for an internal reason");
  require(status != ALLPAIRS_OUT_OF_MEMORY, "no call of this size runs out of memory");
  require(status >= ALLPAIRS_OK && status <= ALLPAIRS_STOPPED, "a status is one of the declared");
  if (status == ALLPAIRS_OK) return status;
  const char* message = allpairs_error_message();
  require(message != nullptr && *message != '\0', "a failure has a message");
  require(std::strchr(message, '\n') == nullptr && std::strlen(message) < 512, "a message is one line");
  return status;
}

/// The context is null where a struct is too short for it.
inline bool acceptSome(void* context, std::uint32_t first, std::uint32_t second) {
  const std::uint32_t salt = context == nullptr ? 0 : *static_cast<const std::uint8_t*>(context);
  return (first * 3 + second + salt) % 4 != 0;
}

struct Seen {
  std::vector<allpairs_pair> pairs;
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

inline bool see(void* context, allpairs_pairs batch) {
  auto& seen = *static_cast<Seen*>(context);
  seen.pairs.insert(seen.pairs.end(), batch.data, batch.data + batch.count);
  return seen.pairs.size() < seen.most;
}

/// A search of one set or, with another, of two; each may be null.
struct CSearch {
  allpairs_search* search = nullptr;
  const allpairs_set* set = nullptr;
  const allpairs_set* other = nullptr;

  /// What finding says, and the pairs; none if they are not found.
  struct Found {
    allpairs_status status = ALLPAIRS_OK;
    std::vector<allpairs_pair> pairs;
  };

  [[nodiscard]] Found find() const {
    allpairs_pairs pairs{};
    const allpairs_status status = checked(other == nullptr ? allpairs_find(search, set, &pairs)
                                                            : allpairs_find_between(search, set, other, &pairs));
    return {status,
            status == ALLPAIRS_OK ? std::vector(pairs.data, pairs.data + pairs.count) : std::vector<allpairs_pair>()};
  }

  /// Finding, counting and streaming agree, also in whether they succeed. Finding may be given nothing to write to.
  void compareAll(std::size_t batch, bool givesNull) const {
    allpairs_pairs found{};
    std::uint64_t count = 0;
    Seen seen;
    const allpairs_status counted = checked(other == nullptr ? allpairs_count(search, set, &count)
                                                             : allpairs_count_between(search, set, other, &count));
    const allpairs_status streamed = stream({see, &seen, batch});
    require(counted == streamed, "counting and streaming succeed or fail alike");
    require(counted != ALLPAIRS_OK || count == seen.pairs.size(), "as many pairs are streamed as are counted");
    if (search != nullptr && set != nullptr) {
      require(statistics().pairs == (counted == ALLPAIRS_OK ? count : 0), "statistics count the pairs that are given");
    }
    allpairs_pairs* const into = givesNull ? nullptr : &found;
    const allpairs_status status =
        checked(other == nullptr ? allpairs_find(search, set, into) : allpairs_find_between(search, set, other, into));
    if (search == nullptr || set == nullptr || givesNull)
      require(status == ALLPAIRS_INVALID_ARGUMENT, "no handle is an invalid argument");
    else
      require(status == counted, "finding and counting succeed or fail alike");
    if (status != ALLPAIRS_OK) return;
    require(std::equal(found.data, found.data + found.count, seen.pairs.begin(), seen.pairs.end(), isPair),
            "the pairs that are found are those that are streamed");
    if (count == 0) return;
    Seen first{.pairs = {}, .most = 1};
    require(stream({see, &first, 0}) == ALLPAIRS_STOPPED, "a visitor stops the search");
  }

  [[nodiscard]] allpairs_overlap_statistics statistics() const {
    allpairs_overlap_statistics result{};
    result.struct_size = sizeof(result);
    require(checked(allpairs_search_statistics(search, &result)) == ALLPAIRS_OK, "a search has statistics");
    return result;
  }

  [[nodiscard]] allpairs_status stream(const allpairs_visitor& visitor) const {
    return checked(other == nullptr ? allpairs_stream(search, set, visitor)
                                    : allpairs_stream_between(search, set, other, visitor));
  }

  /// In memory of the caller is what is found; one place less is too little.
  void compareInto(bool isTooSmall) const {
    const auto [found, expected] = find();
    isTooSmall = isTooSmall && !expected.empty();
    std::vector<allpairs_pair> memory(expected.size());
    allpairs_pair_memory into{memory.data(), memory.size() - (isTooSmall ? 1 : 0), 0};
    const allpairs_status status = checked(other == nullptr ? allpairs_find_into(search, set, &into)
                                                            : allpairs_find_between_into(search, set, other, &into));
    require(isTooSmall ? status != ALLPAIRS_OK : status == found, "what fits is given as if there were room for all");
    if (status != ALLPAIRS_OK) return;
    require(into.count == memory.size() && std::equal(memory.begin(), memory.end(), expected.begin(), isPair),
            "the caller's memory has the pairs that are found");
  }

  /// Rows of neighbors are the pairs by their boxes, in memory of the caller too.
  void compareRows(allpairs_rows_kind kind) const {
    const Found found = find();
    allpairs_rows rows{};
    const allpairs_status status =
        checked(other == nullptr ? allpairs_find_neighbors(search, set, kind, &rows)
                                 : allpairs_find_neighbors_between(search, set, other, &rows));
    require(status == found.status, "rows are found where pairs are");
    if (status != ALLPAIRS_OK) return;
    require(rows.count == allpairs_set_size(set), "each box has a row");
    std::vector<std::vector<std::uint32_t>> partners(rows.count);
    for (const allpairs_pair& pair : found.pairs) {
      partners[pair.first].push_back(pair.second);
      if (other == nullptr && kind == ALLPAIRS_FULL_ROWS) partners[pair.second].push_back(pair.first);
    }
    std::vector<std::uint64_t> begins{0};
    std::vector<std::uint32_t> expected;
    for (std::vector<std::uint32_t>& row : partners) {
      std::sort(row.begin(), row.end());
      expected.insert(expected.end(), row.begin(), row.end());
      begins.push_back(expected.size());
    }
    require(std::equal(begins.begin(), begins.end(), rows.offsets) &&
                std::equal(expected.begin(), expected.end(), rows.indices),
            "a row has the partners of its box");
    std::vector<std::uint64_t> offsets(begins.size());
    std::vector<std::uint32_t> indices(expected.size());
    allpairs_rows_memory memory{offsets.data(), indices.data(), indices.size(), 0};
    require(
        checked(other == nullptr ? allpairs_find_neighbors_into(search, set, kind, &memory)
                                 : allpairs_find_neighbors_between_into(search, set, other, &memory)) == ALLPAIRS_OK,
        "rows fit in memory of their size");
    require(memory.count == expected.size() && offsets == begins && indices == expected,
            "the caller's memory has the rows that are found");
  }
};

/// Finding, counting and streaming candidates agree; false if there are none to compare.
inline bool compareCandidates(allpairs_elements* elements, allpairs_candidates kind) {
  std::uint64_t count = 0;
  Seen seen;
  allpairs_pairs pairs{};
  if (checked(allpairs_elements_count(elements, kind, &count)) != ALLPAIRS_OK) return false;
  require(checked(allpairs_elements_stream(elements, kind, {see, &seen, 0})) == ALLPAIRS_OK, "candidates are streamed");
  require(checked(allpairs_elements_find(elements, kind, &pairs)) == ALLPAIRS_OK, "candidates are found");
  require(count == pairs.count &&
              std::equal(pairs.data, pairs.data + pairs.count, seen.pairs.begin(), seen.pairs.end(), isPair),
          "the candidates that are found are those that are streamed");
  return true;
}

/// Finding, counting and listing in worlds agree.
inline void compareWorlds(allpairs_search* search, const allpairs_worlds& worlds) {
  std::vector<std::uint64_t> begin(worlds.count + 1);
  if (checked(allpairs_count_in_worlds(search, &worlds, begin.data())) != ALLPAIRS_OK) return;
  allpairs_world_pairs found{};
  require(checked(allpairs_find_in_worlds(search, &worlds, &found)) == ALLPAIRS_OK, "what was counted can be found");
  require(std::equal(begin.begin(), begin.end(), found.begin) && found.pairs.count == begin.back(),
          "as many pairs of each world are found as are counted");
  const std::vector<allpairs_pair> expected(found.pairs.data, found.pairs.data + found.pairs.count);
  std::vector<allpairs_pair> listed(expected.size());
  require(checked(allpairs_list_in_worlds(search, &worlds, begin.data(), listed.data())) == ALLPAIRS_OK,
          "what was counted can be listed");
  require(std::equal(listed.begin(), listed.end(), expected.begin(), isPair),
          "the pairs that are listed are those that are found");
}

}  // namespace allpairs::fuzz
