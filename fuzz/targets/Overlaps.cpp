// SPDX-License-Identifier: MIT
// Every way to ask for the pairs of one set or two, against a double loop that shares no code with the engine.
#include "allpairs/Overlaps.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "../BackwardExecutor.h"
#include "../BoxesInMemory.h"
#include "../Choices.h"
#include "allpairs/Error.h"

namespace allpairs::fuzz {
namespace {

constexpr std::size_t kMostBoxes = 300;  // The double loop is quadratic; a hierarchy of three levels fits.

/// A set of boxes with all that may be said about each.
struct Side {
  std::vector<Box> boxes;
  std::optional<BoxesInMemory<float>> float32;
  std::optional<BoxesInMemory<double>> float64;
  BoxView set;
  double margin = 0.0;
  std::vector<double> margins;
  std::vector<std::uint32_t> categories, masks, groups;

  [[nodiscard]] double marginOf(std::size_t i) const { return margins.empty() ? margin : margins[i]; }
};

void readMargins(Choices& choices, Side& side) {
  if (choices.flag()) side.margin = choices.distance();
  if (choices.byte() % 4 == 3) {
    for (std::size_t i = 0; i < side.boxes.size(); ++i) side.margins.push_back(choices.distance());
  }
  side.set.setMargin(side.margin);
  if (!side.margins.empty()) side.set.setMargins(side.margins);
}

void readFilter(Choices& choices, Side& side) {
  const std::uint8_t parts = choices.byte();
  const std::uint8_t pattern = choices.byte();
  for (std::size_t i = 0; i < side.boxes.size(); ++i) {
    const auto value = static_cast<std::uint32_t>((i * 7 + pattern) * 2654435761U >> 13);
    if ((parts & 1U) != 0) side.categories.push_back(1U << value % 3);
    if ((parts & 2U) != 0) side.masks.push_back(value / 3 % 8);
    if ((parts & 4U) != 0) side.groups.push_back(value / 24 % 4);
  }
}

void readSide(Choices& choices, Side& side) {
  while (choices.byte() % 4 != 0) {
    for (const Box& box : choices.boxes(kMostBoxes / 2)) {
      if (side.boxes.size() < kMostBoxes) side.boxes.push_back(box);
    }
  }
  const bool isFloat32 = choices.flag();
  const std::size_t layout = choices.below(BoxesInMemory<float>::kLayouts);
  if (isFloat32) {
    for (Box& box : side.boxes) box = asFloat32(box);
    side.set = side.float32.emplace(side.boxes, layout).view();
  } else {
    side.set = side.float64.emplace(side.boxes, layout).view();
  }
  readMargins(choices, side);
  readFilter(choices, side);
}

bool isNothing(const Box& b) { return b.min[0] > b.max[0] || b.min[1] > b.max[1] || b.min[2] > b.max[2]; }

bool apart(const Box& a, const Box& b, double d) {
  bool result = isNothing(a) || isNothing(b);
  for (std::size_t k = 0; k < 3; ++k) result = result || a.min[k] > b.max[k] + d || b.min[k] > a.max[k] + d;
  return result;
}

/// What the contract says of one question.
struct Oracle {
  const OverlapOptions& options;
  const Side& first;
  const Side& second;
  std::uint32_t salt = 0;

  [[nodiscard]] bool isInRegion(const Side& side, std::size_t i) const {
    return !options.region || !apart(side.boxes[i], *options.region, options.distance + side.marginOf(i));
  }

  [[nodiscard]] bool passesFilter(std::size_t i, std::size_t j) const {
    const auto at = [](const std::vector<std::uint32_t>& list, std::size_t k, std::uint32_t other) {
      return list.empty() ? other : list[k];
    };
    if ((at(first.categories, i, ~0U) & at(second.masks, j, ~0U)) == 0) return false;
    if ((at(second.categories, j, ~0U) & at(first.masks, i, ~0U)) == 0) return false;
    const std::uint32_t group = at(first.groups, i, 0);
    return group == 0 || group != at(second.groups, j, 0);
  }

  /// All but `accept`.
  [[nodiscard]] bool passes(std::size_t i, std::size_t j) const {
    const double d = options.distance + first.marginOf(i) + second.marginOf(j);
    return !apart(first.boxes[i], second.boxes[j], d) && isInRegion(first, i) && isInRegion(second, j) &&
           passesFilter(i, j);
  }

  [[nodiscard]] bool accepts(std::size_t i, std::size_t j) const {
    return salt == 0 || (i * 31 + j * 17 + salt) % 3 != 0;
  }

  [[nodiscard]] std::vector<Pair> pairs() const {
    std::vector<Pair> result;
    for (std::uint32_t i = 0; i < first.boxes.size(); ++i) {
      for (std::uint32_t j = &first == &second ? i + 1 : 0; j < second.boxes.size(); ++j) {
        if (passes(i, j) && accepts(i, j)) result.push_back({i, j});
      }
    }
    if (options.order == Order::BySecond) {
      std::stable_sort(result.begin(), result.end(), [](Pair a, Pair b) { return a.second < b.second; });
    }
    return result;
  }
};

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
