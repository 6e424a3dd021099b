// SPDX-License-Identifier: MIT
#include "Match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "Contenders.h"
#include "Samples.h"
#include "SceneMaker.h"
#include "Stopwatch.h"

namespace allpairs::bench {

namespace {

/// A contender that takes longer than this many times our time is not measured.
constexpr double kHopeless = 8.0;

/// Where all are asked for, one is measured however long it takes, but no longer for a scene than this part of the time
/// that there is.
constexpr double kLongestShare = 30.0;

/// Where we lead by less than this, the match is held again with more care: of many scenes, those at the bottom of the
/// list are there by chance too.
constexpr double kDoubtful = 3.2;

/// Which is the same for the same pairs in any order and orientation.
std::uint64_t hashOf(std::span<const Pair> pairs, bool areTwo) {
  std::uint64_t hash = 0;
  for (Pair pair : pairs) {
    if (!areTwo && pair.first > pair.second) std::swap(pair.first, pair.second);
    std::uint64_t mixed = (std::uint64_t{pair.first} << 32U | pair.second) * 0x9E3779B97F4A7C15U;
    mixed = (mixed ^ (mixed >> 29U)) * 0xBF58476D1CE4E5B9U;
    hash += mixed ^ (mixed >> 32U);
  }
  return hash;
}

struct Finding {
  std::size_t pairs = 0;
  std::uint64_t hash = 0;
};

/// The time of one search of each scene, in nanoseconds. What the last one built is taken down afterwards, off the
/// clock.
template <class T>
struct Turn {
  double ns = 0.0;
  std::size_t pairs = 0;

  Turn(SetSearch<T>& search, std::span<const Scene<T>> scenes) {
    const measure::Stopwatch watch;
    for (const Scene<T>& scene : scenes) pairs += search.find(scene.sets()).size();
    ns = 1e6 * watch.elapsed().cpuMs / static_cast<double>(scenes.size());
    search.clear();
  }
};

/// Scenes in groups; each turn is a group, which is long enough for the clock.
template <class T>
class SceneGroups {
 public:
  SceneGroups(const SceneMaker& maker, std::uint64_t firstNumber) {
    constexpr std::size_t kBoxesOfGroup = 10000;
    constexpr std::size_t kManyBoxes = 200000;
    const std::size_t boxes = maker.family().boxes();
    m_groups = boxes < kManyBoxes ? 4 : 3;
    m_size = std::clamp<std::size_t>(kBoxesOfGroup / boxes, 1, 1000);
    for (std::size_t i = 0; i < m_groups * m_size; ++i) m_scenes.push_back(maker.make<T>(firstNumber + i));
  }

  [[nodiscard]] std::size_t groups() const { return m_groups; }
  [[nodiscard]] std::span<const Scene<T>> group(std::size_t i) const {
    return std::span<const Scene<T>>(m_scenes).subspan(i * m_size, m_size);
  }

 private:
  std::size_t m_groups = 0;
  std::size_t m_size = 0;
  std::vector<Scene<T>> m_scenes;
};

/// Smaller scenes of the same family: they choose the setting of a peer, and tell whether it is worth measuring.
template <class T>
class Trial {
 public:
  explicit Trial(const SceneFamily& family) : m_family(family) {}

  struct Choice {
    std::string setting;
    std::unique_ptr<SetSearch<T>> search;
    double ns = 0.0;  ///< For a scene of the whole size, an estimate.
  };

  /// The best setting. Its time is estimated from larger and larger scenes, until it is known to be more than this: few
  /// boxes tell little of many.
  [[nodiscard]] Choice choose(const SetPeer<T>& peer, double mostNs) {
    constexpr double kSlower = 1.5;  // A setting this much slower at its first try is not tried again.
    Choice choice;
    for (const SetSetting<T>& setting : peer.settings) {
      auto search = setting.make();
      double ns = timeOf(*search, kOfSettings);
      if (choice.search == nullptr || ns < kSlower * choice.ns) ns = std::min(ns, timeOf(*search, kOfSettings));
      if (choice.search == nullptr || ns < choice.ns) choice = {setting.name, std::move(search), ns};
    }
    if (m_family.boxes() <= kSizes[kOfSettings]) return choice;
    double before = std::min(timeOf(*choice.search, 0), timeOf(*choice.search, 0));
    double ns = choice.ns;
    for (std::size_t size = kOfSettings;; before = ns) {
      choice.ns = extrapolated(before, ns, size);
      if (choice.ns > mostNs || ++size == kSizes.size() || kSizes[size] >= m_family.boxes()) return choice;
      ns = timeOf(*choice.search, size);
    }
  }

 private:
  static constexpr std::array<std::size_t, 4> kSizes{500, 2000, 16000, 128000};
  static constexpr std::size_t kOfSettings = 1;
  static constexpr std::uint64_t kFirstNumber = 1U << 20U;  // Not among those that are measured.

  [[nodiscard]] double timeOf(SetSearch<T>& search, std::size_t size) {
    constexpr std::size_t kBoxesTogether = 2000;
    std::vector<Scene<T>>& scenes = m_scenes[size];
    if (scenes.empty()) {
      const SceneMaker maker(shrunk(m_family, kSizes[size]));
      const std::size_t count = std::clamp<std::size_t>(kBoxesTogether / maker.family().boxes(), 1, 200);
      for (std::size_t i = 0; i < count; ++i) scenes.push_back(maker.make<T>(kFirstNumber + i));
    }
    return Turn<T>(search, scenes).ns;
  }

  /// By the power of the number of boxes with which the time grows from the scenes of the size before this one.
  [[nodiscard]] double extrapolated(double before, double ns, std::size_t size) const {
    const auto boxesOf = [this](std::size_t i) { return static_cast<double>(m_scenes[i].front().sets().boxes()); };
    const double power = std::log(ns / before) / std::log(boxesOf(size) / boxesOf(size - 1));
    return ns * std::pow(static_cast<double>(m_family.boxes()) / boxesOf(size), std::clamp(power, 1.0, 2.0));
  }

  SceneFamily m_family;
  std::array<std::vector<Scene<T>>, kSizes.size()> m_scenes;  ///< Made when they are asked for.
};

template <class T>
struct Contender {
  Entry entry;
  std::unique_ptr<SetSearch<T>> search;
  std::vector<double> ns = {};
  bool rests = false;
};

template <class T>
class Match {
 public:
  Match(const SceneFamily& family, const MatchOptions& options) : m_options(options), m_maker(family) {
    m_contenders.push_back({{.name = "overlaps()", .setting = "ordered, a vector"}, orderedOverlaps<T>()});
    m_contenders.push_back({{.name = "find()", .setting = "unordered, kept"}, keptUnorderedFind<T>()});
    draw();
    admitPeers();
    m_order.resize(m_contenders.size());
    std::iota(m_order.begin(), m_order.end(), std::size_t{0});
  }

  MatchResult hold() {
    check();
    takeTurns(m_options.seconds, 1);
    MatchResult quick = result();
    if (std::min(quick.orderedRatio(), quick.unorderedRatio()) > kDoubtful) return quick;
    restSlowOnes(quick);
    draw();
    check();
    takeTurns(m_options.carefulSeconds, 3);
    return result();
  }

 private:
  /// Boxes that nobody has seen.
  void draw() {
    m_scenes.reset();
    m_scenes.emplace(m_maker, m_drawn);
    m_drawn += m_scenes->groups() * m_scenes->group(0).size();
  }

  void admitPeers() {
    Turn<T>(*m_contenders[1].search, m_scenes->group(0));
    const double ours = Turn<T>(*m_contenders[1].search, m_scenes->group(1)).ns;
    Trial<T> trial(m_maker.family());
    const double most = std::max(kHopeless * ours, m_options.all ? 1e9 * m_options.seconds / kLongestShare : 0.0);
    for (const SetPeer<T>& peer : setPeers<T>(m_maker.family().areTwo())) {
      if (!isWanted(peer.name)) continue;
      auto choice = trial.choose(peer, most);
      Contender<T> contender{{.name = peer.name, .setting = choice.setting, .ns = choice.ns}, std::move(choice.search)};
      contender.entry.leftOut = choice.ns > most;
      (contender.entry.leftOut ? m_leftOut : m_contenders).push_back(std::move(contender));
    }
  }

  [[nodiscard]] bool isWanted(const std::string& name) const {
    const auto& only = m_options.peers;
    return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
  }

  /// Those that are far from the fastest need no more care.
  void restSlowOnes(const MatchResult& quick) {
    constexpr double kFar = 3.0;
    for (std::size_t i = 0; i < m_contenders.size(); ++i) {
      const bool isOurs = i < 2;
      m_contenders[i].rests = !isOurs && !m_options.all && quick.entries[i].ns > kFar * quick.best()->ns;
      if (!m_contenders[i].rests) m_contenders[i].ns.clear();
    }
  }

  /// Compares all pairs of some scenes; what runs for the first time is not timed either.
  void check() {
    constexpr std::size_t kMostScenes = 20;
    const auto scenes = m_scenes->group(0).first(std::min(kMostScenes, m_scenes->group(0).size()));
    for (const Scene<T>& scene : scenes) {
      Finding expected;
      for (Contender<T>& contender : m_contenders) {
        if (contender.rests) continue;
        const std::span<const Pair> pairs = contender.search->find(scene.sets());
        const Finding found{pairs.size(), hashOf(pairs, scene.areTwo)};
        if (&contender == m_contenders.data()) expected = found;
        note(contender, found.pairs, expected.pairs);
        if (found.hash != expected.hash) note(contender, "other pairs than ours");
        contender.search->clear();
      }
    }
  }

  void takeTurns(double seconds, int fewestRounds) {
    constexpr int kMostRounds = 50;
    constexpr double kMostMs = 2000.0;  // Slow scenes have to do with fewer rounds.
    const measure::Stopwatch watch;
    double roundMs = 0.0;  // No round is begun that would not end in time.
    const auto endsWithin = [&](double ms) { return watch.elapsed().wallMs + roundMs < ms; };
    const auto goesOn = [&](int round) {
      if (round < fewestRounds) return round == 0 || endsWithin(kMostMs);
      return round < kMostRounds && endsWithin(1e3 * seconds);
    };
    for (int round = 0; goesOn(round); ++round) {
      const measure::Stopwatch ofRound;
      takeRound();
      roundMs = ofRound.elapsed().wallMs;
    }
  }

  /// The contender that begins finds the boxes in no cache, so another one begins each time.
  void takeRound() {
    for (std::size_t i = 0; i < m_scenes->groups(); ++i) {
      std::rotate(m_order.begin(), m_order.begin() + 1, m_order.end());
      std::vector<std::size_t> pairs(m_contenders.size());
      for (const std::size_t number : m_order) {
        Contender<T>& contender = m_contenders[number];
        if (contender.rests) continue;
        const Turn<T> turn(*contender.search, m_scenes->group(i));
        contender.ns.push_back(turn.ns);
        pairs[number] = turn.pairs;
      }
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (!m_contenders[k].rests) note(m_contenders[k], pairs[k], pairs.front());
      }
      m_pairs = static_cast<double>(pairs.front()) / static_cast<double>(m_scenes->group(i).size());
    }
  }

  static void note(Contender<T>& contender, std::size_t pairs, std::size_t expected) {
    if (pairs == expected) return;
    note(contender, std::to_string(pairs) + " pairs instead of " + std::to_string(expected));
  }
  static void note(Contender<T>& contender, const std::string& mistake) {
    if (contender.entry.mistake.empty()) contender.entry.mistake = mistake;
  }

  [[nodiscard]] MatchResult result() const {
    MatchResult result{m_maker.family(), m_pairs, {}};
    for (const Contender<T>& contender : m_contenders) {
      result.entries.push_back(contender.entry);
      result.entries.back().ns = measure::median(contender.ns);
    }
    for (const Contender<T>& contender : m_leftOut) result.entries.push_back(contender.entry);
    return result;
  }

  const MatchOptions& m_options;
  SceneMaker m_maker;
  std::optional<SceneGroups<T>> m_scenes;
  std::vector<Contender<T>> m_contenders;
  std::vector<std::size_t> m_order;  ///< In which they take their next turn.
  std::vector<Contender<T>> m_leftOut;
  std::uint64_t m_drawn = 0;
  double m_pairs = 0.0;
};

}  // namespace

const Entry* MatchResult::best() const {
  const Entry* least = nullptr;
  for (std::size_t i = 2; i < entries.size(); ++i) {
    if (entries[i].leftOut || !entries[i].mistake.empty()) continue;
    if (least == nullptr || entries[i].ns < least->ns) least = &entries[i];
  }
  return least;
}

double MatchResult::ratioTo(const Entry& ours) const {
  const Entry* const least = best();
  return least == nullptr ? std::numeric_limits<double>::infinity() : least->ns / ours.ns;
}

MatchResult holdMatch(const SceneFamily& family, const MatchOptions& options) {
  return family.isFloat64 ? Match<double>(family, options).hold() : Match<float>(family, options).hold();
}

}  // namespace allpairs::bench
