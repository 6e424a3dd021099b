// SPDX-License-Identifier: MIT
#include "Contest.h"

#include <algorithm>
#include <cmath>

#include "PairHash.h"
#include "Stopwatch.h"

namespace allpairs::bench {

namespace {

/// One run; what it built is taken down after the clock has been read.
measure::Duration timeOnce(const MakeSearch& make, std::span<const float> rows) {
  const measure::Stopwatch watch;
  const std::unique_ptr<Search> search = make();
  (void)search->find(rows);
  return watch.elapsed();
}

/// The mean of runs that are too short for the clock; it includes taking down what they built.
measure::Duration timeBatch(const MakeSearch& make, std::span<const float> rows, std::size_t runs) {
  if (runs == 1) return timeOnce(make, rows);
  const measure::Stopwatch watch;
  for (std::size_t run = 0; run < runs; ++run) (void)make()->find(rows);
  return watch.elapsed() / static_cast<double>(runs);
}

std::string describe(const Pair& pair) { return std::to_string(pair.first) + " and " + std::to_string(pair.second); }

/// How `found` differs from `expected`, both in order.
std::string difference(std::span<const Pair> found, std::span<const Pair> expected) {
  const auto [f, e] = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end());
  if (f == found.end() && e == expected.end()) return {};
  std::string text = std::to_string(found.size()) + " pairs instead of " + std::to_string(expected.size());
  if (e == expected.end() || (f != found.end() && *f < *e)) return text + ", first wrong one " + describe(*f);
  return text + ", first missing one " + describe(*e);
}

/// One contender's part in a contest.
class Turn {
 public:
  Turn(const Contender& contender, std::span<const float> rows, const Effort& effort)
      : m_contender(contender), m_rows(rows) {
    m_runs = runsFor(effort, timeOnce(contender.make, rows).wallMs);
    // Once more, now warm, decides how many samples there is time for.
    const double sampleMs = timeBatch(contender.make, rows, m_runs).wallMs * static_cast<double>(m_runs);
    const double samples = effort.secondsEach * 1e3 / std::max(sampleMs, 1e-6);
    m_allowance = static_cast<std::size_t>(
        std::clamp(samples, static_cast<double>(effort.fewestSamples), static_cast<double>(effort.mostSamples)));
  }

  [[nodiscard]] std::size_t allowance() const { return m_allowance; }

  /// Takes a sample in round `round` of `rounds` if it is due: allowances are spread evenly.
  void take(std::size_t round, std::size_t rounds) {
    if ((round + 1) * m_allowance / rounds == round * m_allowance / rounds) return;
    m_samples.add(timeBatch(m_contender.make, m_rows, m_runs));
  }

  [[nodiscard]] measure::Summary summary() const { return m_samples.summary(); }

 private:
  static std::size_t runsFor(const Effort& effort, double runMs) {
    constexpr double kMostRuns = 1000.0;
    return static_cast<std::size_t>(
        std::clamp(std::ceil(effort.shortestSampleMs / std::max(runMs, 1e-6)), 1.0, kMostRuns));
  }

  const Contender& m_contender;
  std::span<const float> m_rows;
  std::size_t m_runs = 1;
  std::size_t m_allowance = 1;
  measure::Samples m_samples;
};

std::vector<measure::Summary> takeTurns(std::span<const Contender> contenders, std::span<const float> rows,
                                        const Effort& effort) {
  std::vector<Turn> turns;
  std::size_t rounds = 1;
  for (const Contender& contender : contenders) {
    turns.emplace_back(contender, rows, effort);
    rounds = std::max(rounds, turns.back().allowance());
  }
  for (std::size_t round = 0; round < rounds; ++round) {
    for (Turn& turn : turns) turn.take(round, rounds);
  }
  std::vector<measure::Summary> summaries;
  for (const Turn& turn : turns) summaries.push_back(turn.summary());
  return summaries;
}

/// Runs each once and compares its pairs, whole, with those of the first.
std::vector<Outcome> compareResults(std::span<const Contender> contenders, std::span<const float> rows) {
  std::vector<Outcome> outcomes(contenders.size());
  std::vector<Pair> expected;
  for (std::size_t k = 0; k < contenders.size(); ++k) {
    if (!contenders[k].givesPairs) continue;
    const std::unique_ptr<Search> search = contenders[k].make();
    std::vector<Pair> found = measure::normalised(search->find(rows));
    outcomes[k].pairs = found.size();
    outcomes[k].hash = measure::hexadecimal(measure::hashOfPairs(found));
    if (k == 0)
      expected = std::move(found);
    else
      outcomes[k].mistake = difference(found, expected);
  }
  return outcomes;
}

}  // namespace

std::vector<Outcome> contest(std::span<const Contender> contenders, std::span<const float> rows, const Effort& effort) {
  std::vector<Outcome> outcomes = compareResults(contenders, rows);
  const std::vector<measure::Summary> summaries = takeTurns(contenders, rows, effort);
  for (std::size_t k = 0; k < outcomes.size(); ++k) outcomes[k].times = summaries[k];
  return outcomes;
}

const Setting& fastestSetting(const Peer& peer, std::span<const float> rows) {
  constexpr double kHopeless = 1.5;  // A setting this much slower at its first try is not tried again.
  const Setting* fastest = &peer.settings.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Setting& setting : peer.settings) {
    if (peer.settings.size() == 1) break;
    double time = timeOnce(setting.make, rows).cpuMs;
    for (int again = 0; again < 2 && time < kHopeless * least; ++again) {
      time = std::min(time, timeOnce(setting.make, rows).cpuMs);
    }
    if (time < least) fastest = &setting;
    least = std::min(least, time);
  }
  return *fastest;
}

}  // namespace allpairs::bench
