// SPDX-License-Identifier: MIT
// Every way to ask for the pairs of one set or two, against a double loop that shares no code with the engine.
#include "allpairs/Overlaps.h"

#include <algorithm>
#include <vector>

#include "../BackwardExecutor.h"
#include "../Choices.h"
#include "../Sides.h"
#include "allpairs/Error.h"
#include "allpairs/Neighbors.h"

namespace allpairs::fuzz {
namespace {

OverlapOptions readOptions(Choices& choices, BackwardExecutor& executor, std::size_t& batchSize) {
  OverlapOptions options;
  options.strategy = static_cast<Strategy>(choices.below(3));
  options.order = static_cast<Order>(choices.below(3));
  options.distance = choices.distance();
  options.instructionSet = instructionSets()[choices.below(instructionSets().size())];
  const std::uint8_t parts = choices.byte();
  if ((parts & 1U) != 0) options.executor = &executor;
  if ((parts & 2U) != 0) batchSize = 1 + choices.below(300);
  if ((parts & 4U) != 0) options.maxPairs = choices.below(1000);
  if ((parts & 24U) == 24) {
    const Box region = choices.box();
    if (!isNothing(region)) options.region = region;
  }
  return options;
}

class Question {
 public:
  Question(OverlapSearch& search, const Oracle& oracle, std::size_t batchSize)
      : m_search(search), m_oracle(oracle), m_batchSize(batchSize), m_expected(oracle.pairs()) {}

  void ask() {
    limited([&] { require(count() == m_expected.size(), "count() is the number of pairs of the double loop"); });
    limited([&] { compare(streamed(), "stream() gives the pairs of the double loop"); });
    limited([&] { compare(found(), "find() gives the pairs of the double loop"); });
    limited([&] { compareRows(); });
  }

 private:
  /// Whatever looks for pairs throws if there are more than it may find, and only then.
  template <class Look>
  void limited(const Look& look) const {
    bool isTooMany = false;
    try {
      look();
    } catch (const LimitExceeded& error) {
      isTooMany = true;
      require(error.count() > m_oracle.options.maxPairs, "LimitExceeded counts more pairs than the limit");
    }
    require(isTooMany == (m_expected.size() > m_oracle.options.maxPairs), "more pairs than maxPairs are an error");
  }

  [[nodiscard]] bool isOne() const { return &m_oracle.first == &m_oracle.second; }

  std::uint64_t count() {
    return isOne() ? m_search.count(m_oracle.first.set) : m_search.count(m_oracle.first.set, m_oracle.second.set);
  }

  std::vector<Pair> found() {
    const auto pairs =
        isOne() ? m_search.find(m_oracle.first.set) : m_search.find(m_oracle.first.set, m_oracle.second.set);
    require(m_search.statistics().pairs == pairs.size(), "statistics().pairs is the number of pairs");
    return {pairs.begin(), pairs.end()};
  }

  std::vector<Pair> streamed() {
    std::vector<Pair> pairs;
    const auto take = [&](std::span<const Pair> batch) {
      require(!batch.empty() && batch.size() <= m_batchSize, "a batch holds 1 to batchSize pairs");
      pairs.insert(pairs.end(), batch.begin(), batch.end());
      require(pairs.size() <= m_oracle.options.maxPairs, "no more pairs are streamed than the limit");
    };
    if (isOne()) m_search.stream(m_oracle.first.set, take, m_batchSize);
    if (!isOne()) m_search.stream(m_oracle.first.set, m_oracle.second.set, take, m_batchSize);
    return pairs;
  }

  /// Rows of one set are once those of the lower index, once of both.
  void compareRows() {
    std::vector<Pair> expected = m_expected;
    std::sort(expected.begin(), expected.end());
    const BoxView& first = m_oracle.first.set;
    const NeighborsView half = isOne() ? m_search.findNeighbors(first, NeighborRows::Half)
                                       : m_search.findNeighbors(first, m_oracle.second.set);
    require(pairsOf(half) == expected, "rows hold the pairs of the double loop, in order");
    if (!isOne()) return;
    for (const Pair pair : m_expected) expected.push_back({pair.second, pair.first});
    std::sort(expected.begin(), expected.end());
    require(pairsOf(m_search.findNeighbors(first)) == expected, "full rows hold each pair in both rows, in order");
  }

  [[nodiscard]] std::vector<Pair> pairsOf(const NeighborsView& rows) const {
    require(rows.size() == m_oracle.first.boxes.size(), "there is a row for each box");
    std::vector<Pair> pairs;
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
      for (const std::uint32_t other : rows[row]) pairs.push_back({row, other});
    }
    return pairs;
  }

  void compare(std::vector<Pair> pairs, std::string_view property) const {
    if (m_oracle.options.order == Order::Unordered) std::sort(pairs.begin(), pairs.end());
    require(pairs == m_expected, property);
  }

  OverlapSearch& m_search;
  const Oracle& m_oracle;
  std::size_t m_batchSize;
  std::vector<Pair> m_expected;
};

void searchOnce(Choices& choices, OverlapSearch& search) {
  Side first, second;
  readSide(choices, first);
  const bool isOne = choices.flag();
  if (!isOne) readSide(choices, second);
  BackwardExecutor executor;
  std::size_t batchSize = kBatchSize;
  OverlapOptions options = readOptions(choices, executor, batchSize);
  options.filter.first = {first.categories, first.masks, first.groups};
  if (!isOne) options.filter.second = {second.categories, second.masks, second.groups};
  const Oracle oracle{options, first, isOne ? first : second, choices.byte() % 8U};
  if (oracle.salt != 0) {
    options.filter.accept = [&](std::uint32_t i, std::uint32_t j) {
      require(oracle.passes(i, j), "accept is asked only about pairs that pass the rest");
      return oracle.accepts(i, j);
    };
  }
  search.setOptions(options);
  Question(search, oracle, batchSize).ask();
  search.setOptions({});
}

void runOverlaps(Bytes bytes) {
  Choices choices(bytes);
  OverlapSearch search;
  for (int round = 0; round < 3 && !choices.done(); ++round) searchOnce(choices, search);
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(overlaps, allpairs::fuzz::runOverlaps)
