// SPDX-License-Identifier: MIT
#include "allpairs/fcl/FclNarrowPhase.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "Enclosure.h"
#include "ExactBody.h"
#include "LooksInOrder.h"
#include "Meeting.h"
#include "PartSearch.h"
#include "allpairs/Error.h"

namespace allpairs {
namespace {

using exact::ExactBody;
using exact::ExactPart;
using exact::LooksInOrder;
using exact::Meeting;
using exact::PartPair;
using exact::PartSearch;

/// Evenly sampled, at most so many.
template <class To, class From, class Convert>
void sample(const std::vector<From>& from, std::size_t limit, std::vector<To>& to, const Convert& convert) {
  const std::size_t count = std::min(from.size(), limit);
  for (std::size_t i = 0; i < count; ++i) to.push_back(convert(from[i * from.size() / count]));
}

/// Puts the parts of two bodies together: the nearest while all are apart, the deepest once any meet.
class PairReport {
 public:
  PairReport(ExactPair& pair, const ExactOptions& options) : m_pair(pair), m_options(options) {}

  /// Parts that are further apart change nothing that is reported.
  [[nodiscard]] double limit() const {
    if (m_isFirst) return std::numeric_limits<double>::infinity();
    return isMet() ? 0.0 : m_best.distance;
  }

  void add(const ExactPart& first, const ExactPart& second, Meeting meeting) {
    addContacts(meeting);
    if (meeting.isFirstWithin) m_within.insert(&first);
    if (meeting.isSecondWithin) m_within.insert(&second);
    m_hasVolume = m_hasVolume || meeting.hasVolume;
    m_isCrossed = m_isCrossed || meeting.isCrossed;
    m_mayHold = m_mayHold || mayHold(first, second) || mayHold(second, first);
    const bool isBetter =
        m_isFirst || rank(meeting) > rank(m_best) ||
        (rank(meeting) == rank(m_best) && (meeting.depth > m_best.depth || meeting.distance < m_best.distance));
    m_anyMeets = m_anyMeets || meeting.surfacesMeet;
    m_anyIsDeep = m_anyIsDeep || meeting.isDeep;
    m_isFirst = false;
    meeting.contactPoints.clear();
    meeting.contactLines.clear();
    if (isBetter) m_best = std::move(meeting);
  }

  void finish(const ExactBody& first, const ExactBody& second) {
    m_pair.state = stateOf(first, second);
    m_pair.isFirstInner = m_pair.state == ExactState::Contained && isWithin(first);
    m_pair.pointOnFirst = exact::toVec3(m_best.onFirst);
    m_pair.pointOnSecond = exact::toVec3(m_best.onSecond);
    m_pair.normal = exact::toVec3(m_best.normal);
    if (!isMet()) {
      m_pair.distance = m_best.distance;
    } else if (m_hasVolume && (m_anyIsDeep || m_pair.state == ExactState::Touching)) {
      m_pair.depth = m_anyIsDeep ? m_best.depth : 0.0;
    }
    sample(m_points, m_options.contactLimit, m_pair.contactPoints, exact::toVec3);
    sample(m_lines, m_options.lineLimit, m_pair.contactLines, [](const std::array<exact::Point, 2>& line) {
      return std::array{exact::toVec3(line[0]), exact::toVec3(line[1])};
    });
  }

 private:
  [[nodiscard]] bool isMet() const { return m_anyMeets || m_anyIsDeep; }
  static int rank(const Meeting& meeting) { return meeting.isDeep ? 2 : (meeting.surfacesMeet ? 1 : 0); }

  [[nodiscard]] ExactState stateOf(const ExactBody& first, const ExactBody& second) const {
    if (!isMet()) return stateOfApart();
    if (m_anyIsDeep && (isWithin(first) || isWithin(second))) return ExactState::Contained;
    const bool isShallow = m_anyIsDeep && m_best.depth <= m_options.leastDepth;
    return (m_anyIsDeep || m_isCrossed) && !isShallow ? ExactState::Clash : ExactState::Touching;
  }

  [[nodiscard]] ExactState stateOfApart() const {
    if (m_mayHold) return ExactState::Undecided;
    const bool isNear = m_options.clearance > 0.0 && m_best.distance <= m_options.clearance;
    return isNear ? ExactState::WithinClearance : ExactState::Apart;
  }

  [[nodiscard]] bool isWithin(const ExactBody& body) const {
    return std::all_of(body.parts.begin(), body.parts.end(),
                       [this](const auto& part) { return m_within.count(part.get()) != 0; });
  }

  /// Whether a part lies within the box of an open surface, of which nobody can tell the inside. The boxes meet, so
  /// that all such parts are added.
  static bool mayHold(const ExactPart& outer, const ExactPart& inner) {
    return outer.isOpen() && exact::holds(outer.box(), inner.box(), -inner.radius());
  }

  void addContacts(const Meeting& meeting) {
    m_pair.contactCount += meeting.contactCount;
    for (const exact::Point& point : meeting.contactPoints) exact::include(m_pair.contactBox, point);
    m_points.insert(m_points.end(), meeting.contactPoints.begin(), meeting.contactPoints.end());
    m_lines.insert(m_lines.end(), meeting.contactLines.begin(), meeting.contactLines.end());
  }

  ExactPair& m_pair;
  const ExactOptions& m_options;
  Meeting m_best;
  bool m_isFirst = true;
  bool m_anyMeets = false;
  bool m_anyIsDeep = false;
  bool m_isCrossed = false;
  bool m_hasVolume = false;
  bool m_mayHold = false;
  std::unordered_set<const ExactPart*> m_within;
  std::vector<exact::Point> m_points;
  std::vector<std::array<exact::Point, 2>> m_lines;
};

/// Duplicates meet everywhere: what is reported is all of them.
void reportSame(const ExactBody& body, ExactPair& pair) {
  pair.state = ExactState::Duplicate;
  for (const Box& box : body.boxes) pair.contactBox = merge(pair.contactBox, box);
  for (const auto& part : body.parts) pair.contactCount += part->triangles().size();
  for (std::size_t axis = 0; axis < 3; ++axis)
    pair.pointOnFirst[axis] = pair.contactBox.min[axis] / 2.0 + pair.contactBox.max[axis] / 2.0;
  pair.pointOnSecond = pair.pointOnFirst;
}

bool isAnyOpen(const ExactBody& body) {
  return std::any_of(body.parts.begin(), body.parts.end(), [](const auto& part) { return part->isOpen(); });
}

/// Far from the origin no place is known better, in steps from one number to the next.
constexpr double kRoundings = 4.0;

void checkOptions(const ExactOptions& options) {
  // Tolerances are parts of an extent, which may be 0.
  const auto isPart = [](double value) { return value >= 0.0 && std::isfinite(value); };
  if (!isPart(options.tolerance)) throw InvalidArgument("the tolerance of an exact test is negative, infinite or NaN");
  if (!isPart(options.duplicateTolerance))
    throw InvalidArgument("the tolerance of duplicates is negative, infinite or NaN");
  if (!(options.clearance >= 0.0)) throw InvalidArgument("the clearance of an exact test is negative or NaN");
  if (!(options.leastDepth >= 0.0)) throw InvalidArgument("the least depth of a clash is negative or NaN");
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
    pair.isFirstOpen = isAnyOpen(first);
    pair.isSecondOpen = isAnyOpen(second);
    const double extent = std::max(first.extent, second.extent);
    const double rounding = kRoundings * std::numeric_limits<double>::epsilon() * std::max(first.reach, second.reach);
    const exact::Tolerances tolerances{std::max(options.tolerance * extent, rounding),
                                       std::max(options.duplicateTolerance * extent, rounding)};
    if (exact::areSame(first, second, tolerances.same)) return reportSame(first, pair);
    PairReport report(pair, options);
    const auto meetingOf = [&](const PartPair& parts) {
      return exact::meet(*first.parts[parts.first], *second.parts[parts.second], tolerances);
    };
    const auto add = [&](const PartPair& parts, Meeting meeting) {
      report.add(*first.parts[parts.first], *second.parts[parts.second], std::move(meeting));
    };
    const PartSearch search(first, second);
    search.visitMeeting([&](const PartPair& parts) { add(parts, meetingOf(parts)); });
    if (report.limit() > 0.0) {
      LooksInOrder looks(search, report.limit(), tolerances.meeting);
      search.visitApart(report.limit(), [&](const PartPair& parts) { return looks.add(parts, meetingOf(parts)); });
      for (auto& [parts, meeting] : looks.take()) {
        if (parts.distance > report.limit()) break;
        add(parts, std::move(meeting));
      }
    }
    report.finish(first, second);
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

Span<const ExactPair> FclNarrowPhase::pairs() const { return m_state->pairs; }

}  // namespace allpairs
