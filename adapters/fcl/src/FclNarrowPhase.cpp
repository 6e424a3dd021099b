// SPDX-License-Identifier: MIT
#include "allpairs/fcl/FclNarrowPhase.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "ExactBody.h"
#include "Meeting.h"
#include "allpairs/Error.h"

namespace allpairs {
namespace {

using exact::ExactBody;
using exact::ExactPart;
using exact::Meeting;

/// Puts the parts of two bodies together: the nearest while all are apart, the deepest once any meet.
class PairReport {
 public:
  PairReport(ExactPair& pair, std::size_t contactLimit) : m_pair(pair), m_limit(contactLimit) {}

  /// Whether parts that are at least so far apart change nothing that is reported.
  [[nodiscard]] bool isBeyond(double distance) const {
    return !m_isFirst && distance > (isMet() ? 0.0 : m_best.distance);
  }

  void add(Meeting meeting) {
    addContacts(meeting);
    m_hasVolume = m_hasVolume || meeting.hasVolume;
    const bool isBetter =
        m_isFirst || rank(meeting) > rank(m_best) ||
        (rank(meeting) == rank(m_best) && (meeting.depth > m_best.depth || meeting.distance < m_best.distance));
    m_anyMeets = m_anyMeets || meeting.surfacesMeet;
    m_anyIsDeep = m_anyIsDeep || meeting.isDeep;
    m_isFirst = false;
    meeting.contactPoints.clear();
    if (isBetter) m_best = std::move(meeting);
  }

  void finish() {
    m_pair.state = state();
    m_pair.pointOnFirst = exact::toVec3(m_best.onFirst);
    m_pair.pointOnSecond = exact::toVec3(m_best.onSecond);
    m_pair.normal = exact::toVec3(m_best.normal);
    if (!isMet()) {
      m_pair.distance = m_best.distance;
    } else if (m_hasVolume) {
      m_pair.depth = m_anyIsDeep ? m_best.depth : 0.0;
    }
    choosePoints();
  }

 private:
  [[nodiscard]] bool isMet() const { return m_anyMeets || m_anyIsDeep; }
  static int rank(const Meeting& meeting) { return meeting.isDeep ? 2 : (meeting.surfacesMeet ? 1 : 0); }

  [[nodiscard]] ExactState state() const {
    if (!isMet()) return ExactState::Apart;
    if (!m_anyIsDeep) return ExactState::Touching;
    return m_anyMeets ? ExactState::Overlapping : ExactState::Contained;
  }

  void addContacts(const Meeting& meeting) {
    m_pair.contactCount += meeting.contactCount;
    for (const exact::Point& point : meeting.contactPoints) {
      exact::include(m_pair.contactBox, point);
      m_points.push_back(exact::toVec3(point));
    }
  }

  void choosePoints() {
    const std::size_t count = std::min(m_points.size(), m_limit);
    for (std::size_t i = 0; i < count; ++i) m_pair.contactPoints.push_back(m_points[i * m_points.size() / count]);
  }

  ExactPair& m_pair;
  std::size_t m_limit;
  Meeting m_best;
  bool m_isFirst = true;
  bool m_anyMeets = false;
  bool m_anyIsDeep = false;
  bool m_hasVolume = false;
  std::vector<collision::Vec3> m_points;
};

struct PartPair {
  double distance = 0.0;
  const ExactPart* first = nullptr;
  const ExactPart* second = nullptr;
};

/// All parts of one body with all of the other, those with the nearest boxes first.
std::vector<PartPair> partPairs(const ExactBody& first, const ExactBody& second) {
  std::vector<PartPair> pairs;
  for (const auto& a : first.parts) {
    for (const auto& b : second.parts) pairs.push_back({exact::boxDistance(*a, *b), a.get(), b.get()});
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PartPair& a, const PartPair& b) { return a.distance < b.distance; });
  return pairs;
}

void checkOptions(const ExactOptions& options) {
  if (!(options.tolerance >= 0.0)) throw InvalidArgument("the tolerance of an exact test is negative or NaN");
}

}  // namespace

struct FclNarrowPhase::State {
  ExactOptions options;
  std::unordered_map<const collision::CollisionModel*, ExactBody> bodies;
  std::vector<ExactPair> pairs;

  const ExactBody& bodyOf(const collision::CollisionModel& model) {
    const auto found = bodies.find(&model);
    return found != bodies.end() ? found->second : bodies.emplace(&model, exact::makeBody(model)).first->second;
  }

  void examine(ExactPair& pair) {
    const ExactBody& first = bodyOf(*pair.first);
    const ExactBody& second = bodyOf(*pair.second);
    const bool isKnown = first.isKnown && second.isKnown && !first.parts.empty() && !second.parts.empty();
    if (!isKnown || pair.first == pair.second) return;
    const double tolerance = options.tolerance * std::max(first.extent, second.extent);
    PairReport report(pair, options.contactLimit);
    for (const PartPair& parts : partPairs(first, second)) {
      if (report.isBeyond(parts.distance)) break;
      report.add(exact::meet(*parts.first, *parts.second, tolerance));
    }
    report.finish();
  }
};

FclNarrowPhase::FclNarrowPhase(const ExactOptions& options) : m_state(std::make_unique<State>()) {
  checkOptions(options);
  m_state->options = options;
}

FclNarrowPhase::~FclNarrowPhase() = default;

void FclNarrowPhase::beginNarrowPhase() {
  m_state->bodies.clear();
  m_state->pairs.clear();
}

void FclNarrowPhase::addCollisionPair(const collision::CollisionModelPair& pair) {
  if (pair.first == nullptr || pair.second == nullptr)
    throw InvalidArgument("a pair for the narrow phase has no model");
  ExactPair result;
  result.first = pair.first->getLast();
  result.second = pair.second->getLast();
  m_state->examine(result);
  m_state->pairs.push_back(std::move(result));
}

std::span<const ExactPair> FclNarrowPhase::pairs() const { return m_state->pairs; }

}  // namespace allpairs
