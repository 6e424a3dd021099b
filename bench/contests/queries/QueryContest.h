// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "allpairs/WorldTypes.h"

namespace allpairs::bench {

/// What is asked, and of what: rows of 6, and as many queries of each kind as there are.
struct QueryScene {
  std::vector<float> rows;
  std::vector<float> boxes;  ///< Rows of 6.
  std::vector<Ray> rays;
  std::vector<std::array<double, 3>> points;
};

/// The kinds of query that are measured.
enum class QueryKind { Overlapping, FirstHit, AllHits, Nearest1, Nearest8 };

inline constexpr std::array kQueryKinds{QueryKind::Overlapping, QueryKind::FirstHit, QueryKind::AllHits,
                                        QueryKind::Nearest1, QueryKind::Nearest8};
inline constexpr std::array<const char*, 5> kQueryNames{"overlapping a box", "first on a ray", "all on a ray",
                                                        "nearest", "nearest 8"};

/// What a batch of queries gave: for each query its numbers, which can be compared. They are ids, times or distances.
struct Answers {
  std::vector<std::size_t> ends;  ///< By query: where its numbers end.
  std::vector<double> numbers;

  void clear() {
    ends.clear();
    numbers.clear();
  }
};

/// A structure over the boxes of a scene, made before the clock starts, that answers queries.
class QueryIndex {
 public:
  QueryIndex() = default;
  QueryIndex(const QueryIndex&) = delete;
  QueryIndex& operator=(const QueryIndex&) = delete;
  QueryIndex(QueryIndex&&) = delete;
  QueryIndex& operator=(QueryIndex&&) = delete;
  virtual ~QueryIndex() = default;

  [[nodiscard]] virtual bool answers(QueryKind kind) const = 0;

  /// Answers all queries of a kind; this is what is timed.
  virtual void run(QueryKind kind, const QueryScene& scene) = 0;

  /// What the last run gave, with the numbers of each query in any order.
  virtual void collect(Answers& answers) const = 0;
};

struct QueryContender {
  std::string name;
  std::string setting;
  std::unique_ptr<QueryIndex> index;
};

void addOwnIndices(const QueryScene& scene, std::vector<QueryContender>& contenders);

// One file each; those that were left out of the build are not called.
void addEmbreeIndex(const QueryScene& scene, std::vector<QueryContender>& contenders);
void addBoostIndex(const QueryScene& scene, std::vector<QueryContender>& contenders);

}  // namespace allpairs::bench
