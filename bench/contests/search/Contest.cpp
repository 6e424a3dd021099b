// SPDX-License-Identifier: MIT
#include "Contest.h"

#include <algorithm>
#include <limits>

#include "PairHash.h"
#include "Stopwatch.h"

namespace allpairs::bench {

namespace {

/// One run; teardown is not timed.
measure::Duration timeOnce(const MakeSearch& make, std::span<const float> rows) {
  const measure::Stopwatch watch;
  const std::unique_ptr<Search> search = make();
  (void)search->find(rows);
  return watch.elapsed();
}

/// Runs of one contender, each on the set after the one before.
class Runs {
 public:
  Runs(const MakeSearch& make, const BoxSets& sets) : m_make(make), m_sets(sets) {}

  /// The mean of runs that are too short for the clock; it includes taking down what they built.
  measure::Duration operator()(std::size_t runs) {
    if (runs == 1) return timeOnce(m_make, nextSet());
    const measure::Stopwatch watch;
    for (std::size_t run = 0; run < runs; ++run) (void)m_make()->find(nextSet());
    return watch.elapsed() / static_cast<double>(runs);
  }

 private:
  std::span<const float> nextSet() { return m_sets[m_next++ % m_sets.size()]; }

  const MakeSearch& m_make;
  const BoxSets& m_sets;
  std::size_t m_next = 0;
};

std::string describe(const Pair& pair) { return std::to_string(pair.first) + " and " + std::to_string(pair.second); }

std::string difference(std::uint64_t found, std::uint64_t expected) {
  return found == expected ? "" : std::to_string(found) + " pairs instead of " + std::to_string(expected);
}

/// How `found` differs from `expected`, both in order.
std::string difference(std::span<const Pair> found, std::span<const Pair> expected) {
  const auto [f, e] = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end());
  if (f == found.end() && e == expected.end()) return {};
  const std::string text = std::to_string(found.size()) + " pairs instead of " + std::to_string(expected.size());
  if (e == expected.end() || (f != found.end() && *f < *e)) return text + ", first wrong one " + describe(*f);
  return text + ", first missing one " + describe(*e);
}

std::vector<measure::Summary> takeTurns(std::span<const Contender> contenders, const BoxSets& sets,
                                        const measure::Effort& effort) {
  std::vector<measure::Sampling> turns;
  std::size_t rounds = 1;
  for (const Contender& contender : contenders) {
    turns.emplace_back(Runs(contender.make, sets), effort);
    rounds = std::max(rounds, turns.back().allowance());
  }
  // Who has fewer samples takes them in rounds that are spread evenly over the whole.
  const auto isDue = [rounds](std::size_t round, std::size_t allowance) {
    return (round + 1) * allowance / rounds != round * allowance / rounds;
  };
  for (std::size_t round = 0; round < rounds; ++round) {
    for (measure::Sampling& turn : turns) {
      if (isDue(round, turn.allowance())) turn.take();
    }
  }
  std::vector<measure::Summary> summaries;
  for (const measure::Sampling& turn : turns) summaries.push_back(turn.summary());
  return summaries;
}

/// What a contender says of one set.
struct Answer {
  std::vector<Pair> pairs;  ///< In order; none of one that only counts.
  std::uint64_t count = 0;
};

Answer answerOf(const Contender& contender, std::span<const float> rows) {
  const std::unique_ptr<Search> search = contender.make();
  const std::span<const Pair> found = search->find(rows);
  if (!contender.givesPairs) return {{}, search->count()};
  Answer answer{measure::normalised(found), found.size()};
  return answer;
}

/// Runs each once on every set and compares its pairs, whole, with those of the first.
std::vector<Outcome> compareResults(std::span<const Contender> contenders, const BoxSets& sets) {
  std::vector<Outcome> outcomes(contenders.size());
  for (const std::vector<float>& rows : sets) {
    Answer expected;
    for (std::size_t k = 0; k < contenders.size(); ++k) {
      Answer found = answerOf(contenders[k], rows);
      const bool havePairs = contenders[k].givesPairs && contenders.front().givesPairs;
      if (&rows == &sets.front()) outcomes[k].pairs = found.count;
      if (&rows == &sets.front() && contenders[k].givesPairs)
        outcomes[k].hash = measure::hexadecimal(measure::hashOfPairs(found.pairs));
      if (k == 0)
        expected = std::move(found);
      else if (outcomes[k].mistake.empty())
        outcomes[k].mistake =
            havePairs ? difference(found.pairs, expected.pairs) : difference(found.count, expected.count);
    }
  }
  return outcomes;
}

}  // namespace

std::vector<Outcome> contest(std::span<const Contender> contenders, const BoxSets& sets,
                             const measure::Effort& effort) {
  std::vector<Outcome> outcomes = compareResults(contenders, sets);
  const std::vector<measure::Summary> summaries = takeTurns(contenders, sets, effort);
  for (std::size_t k = 0; k < outcomes.size(); ++k) outcomes[k].times = summaries[k];
  return outcomes;
}

const Setting* fastestSetting(const Peer& peer, std::span<const float> rows) {
  constexpr double kHopeless = 1.5;  // A setting this much slower at its first try is not tried again.
  const Setting* fastest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Setting& setting : peer.settings) {
    if (rows.size() / 6 > setting.mostBoxes) continue;
    double time = timeOnce(setting.make, rows).cpuMs;
    for (int again = 0; again < 2 && time < kHopeless * least; ++again) {
      time = std::min(time, timeOnce(setting.make, rows).cpuMs);
    }
    if (time < least) fastest = &setting;
    least = std::min(least, time);
  }
  return fastest;
}

}  // namespace allpairs::bench
