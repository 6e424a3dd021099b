// SPDX-License-Identifier: MIT
#include "Meeting.h"

#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "Around.h"
#include "Deeper.h"
#include "Deepest.h"
#include "Enclosure.h"
#include "Flush.h"
#include "Nearest.h"
#include "PointTriangle.h"
#include "Thick.h"
#include "TriangleMeeting.h"

namespace allpairs::exact {
namespace {

const ::fcl::Transform3d kHere = ::fcl::Transform3d::Identity();

Point middleOf(const Box& box) { return (toPoint(box.min) + toPoint(box.max)) / 2.0; }

Point directionOf(const Point& vector) {
  const double length = vector.norm();
  return length > 0.0 ? Point(vector / length) : Point(Point::Zero());
}

constexpr std::size_t kMostNormals = 32;  // each costs a pass over both parts

/// From where to where a part reaches along a direction.
std::pair<double, double> span(const ExactPart& part, const Point& direction) {
  double min = std::numeric_limits<double>::infinity();
  double max = -min;
  for (const Corners& corners : part.triangles()) {
    for (const Point& corner : corners) {
      min = std::min(min, direction.dot(corner));
      max = std::max(max, direction.dot(corner));
    }
  }
  return {min, max};
}

/// The triangles of the two parts that FCL finds to meet, in the order of their numbers.
std::vector<TrianglePair> meetingTriangles(const ExactPart& first, const ExactPart& second) {
  const ::fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), false);
  ::fcl::CollisionResultd result;
  ::fcl::collide(&first.hierarchy(), kHere, &second.hierarchy(), kHere, request, result);
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    const auto& contact = result.getContact(i);
    pairs.push_back({static_cast<std::size_t>(contact.b1), static_cast<std::size_t>(contact.b2)});
  }
  std::sort(pairs.begin(), pairs.end(), [](const TrianglePair& a, const TrianglePair& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return pairs;
}

/// The part of a look at two parts that takes several steps.
class Look {
 public:
  Look(const ExactPart& first, const ExactPart& second, const Tolerances& tolerances)
      : m_first(first),
        m_second(second),
        m_tolerance(tolerances.meeting),
        m_sameTolerance(tolerances.same),
        m_radius(first.radius() + second.radius()) {}

  Meeting take() {
    measure();
    findTriangles();
    findDepth();
    lookBesideFlushPlaces();
    findWithin();
    if (!m_meeting.surfacesMeet && !m_meeting.isDeep) return std::move(m_meeting);
    m_meeting.distance = 0.0;
    if (m_meeting.normal.isZero()) guessNormal();
    return std::move(m_meeting);
  }

 private:
  /// The distance of the two surfaces, and where they are nearest.
  void measure() {
    const Nearest points = nearest(m_first, m_second);
    m_coreDistance = points.distance;
    const bool coresMeet = m_radius > 0.0 && m_coreDistance <= m_tolerance;
    m_meeting.normal = coresMeet ? normalWhereCoresMeet(m_first, m_second, points.onFirst, m_tolerance)
                                 : directionOf(points.onFirst - points.onSecond);
    m_meeting.onFirst = points.onFirst - m_first.radius() * m_meeting.normal;
    m_meeting.onSecond = points.onSecond + m_second.radius() * m_meeting.normal;
    m_meeting.distance = std::max(0.0, m_coreDistance - m_radius);
    m_contact = m_radius > 0.0 ? contactOfThick(m_first, m_second, points, m_tolerance)
                               : Point((points.onFirst + points.onSecond) / 2.0);
    m_isInReach = m_coreDistance <= m_radius + m_tolerance;
    m_meeting.surfacesMeet = m_isInReach && !isFree(m_first, m_second) && !isFree(m_second, m_first);
    m_meeting.hasVolume = m_radius > 0.0 || m_first.volume() != Volume::None || m_second.volume() != Volume::None;
  }

  /// Whether one lies in a ball or a capsule, away from the surface of that: by so much that they share volume.
  [[nodiscard]] bool isFree(const ExactPart& inner, const ExactPart& outer) const {
    return outer.radius() > 0.0 && isWithin(outer, inner, -2.0 * m_tolerance);
  }

  /// The triangles that meet, and a point of each pair of them; of thick parts one.
  void findTriangles() {
    if (!m_meeting.surfacesMeet) return;
    if (m_radius == 0.0) m_pairs = meetingTriangles(m_first, m_second);
    for (const TrianglePair& pair : m_pairs) {
      const auto meeting = meetingOf(m_first.triangles()[pair.first], m_second.triangles()[pair.second]);
      if (!meeting) continue;
      m_meeting.contactPoints.push_back(meeting->middle);
      if (meeting->ends[0] != meeting->ends[1]) m_meeting.contactLines.push_back(meeting->ends);
      noteIfFlush(pair, *meeting);
      m_crossing = std::max(m_crossing, meeting->crossing);
      if (!m_first.hasArea() || !m_second.hasArea()) m_passing = std::max(m_passing, meeting->passing);
    }
    m_meeting.isCrossed = m_crossing > m_tolerance || crossesAlongEdges();
    if (m_meeting.contactPoints.empty()) m_meeting.contactPoints.push_back(m_contact);
    m_meeting.contactCount = std::max<std::size_t>(m_pairs.size(), 1);
  }

  void noteIfFlush(const TrianglePair& pair, const TriangleMeeting& meeting) {
    const Point normal = directionOf(normalOf(m_first.triangles()[pair.first]));
    const Point other = directionOf(normalOf(m_second.triangles()[pair.second]));
    if (normal.isZero() || other.isZero() || normal.cross(other).norm() > kSameAngle) return;
    m_flush.push_back({meeting.middle, normal});
  }

  /// The lines in which triangles cross, each once.
  [[nodiscard]] std::vector<std::array<Point, 2>> distinctLines() const {
    std::vector<std::array<Point, 2>> lines = m_meeting.contactLines;
    for (auto& [from, to] : lines) {
      if (toVec3(to) < toVec3(from)) std::swap(from, to);
    }
    const auto keyOf = [](const std::array<Point, 2>& ends) { return std::pair(toVec3(ends[0]), toVec3(ends[1])); };
    std::sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) { return keyOf(a) < keyOf(b); });
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
  }

  /// Whether the surfaces pass through each other where edges of their triangles lie on the line: each triangle ends
  /// there, and the surface goes on in the next one. Around the line they take turns then.
  [[nodiscard]] bool crossesAlongEdges() const {
    const std::vector<std::array<Point, 2>> lines = distinctLines();
    const std::size_t stride = lines.size() / kMostLines + 1;
    for (std::size_t i = 0; i < lines.size(); i += stride) {
      const auto& [from, to] = lines[i];
      if ((to - from).norm() <= m_tolerance) continue;
      for (const double at : {0.25, 0.5, 0.75}) {
        if (takeTurnsAt(from + at * (to - from), (to - from) / 64.0)) return true;
      }
    }
    return false;
  }

  /// FCL leaves out triangles that meet others but for rounding: all that hold this piece of the line are asked.
  [[nodiscard]] bool takeTurnsAt(const Point& point, const Point& step) const {
    Around around(point, directionOf(step), m_tolerance);
    const auto addOf = [&](const ExactPart& part, Around::Surface surface) {
      const auto isNear = [&](const Corners& corners, const Point& p) {
        return (nearestPoint(corners, p) - p).norm() <= m_tolerance;
      };
      for (std::size_t i = 0; i < part.triangles().size(); ++i) {
        if (!overlap(part.triangleBoxes()[i], {toVec3(point), toVec3(point)}, m_tolerance)) continue;
        const Corners& corners = part.triangles()[i];
        if (isNear(corners, point - step) && isNear(corners, point + step)) around.add(corners, surface);
      }
    };
    addOf(m_first, Around::Surface::First);
    addOf(m_second, Around::Surface::Second);
    return around.takeTurns();
  }

  void findDepth() {
    const Deepest ofFirst = deepestWithin(m_second, m_first, m_pairs);
    std::vector<TrianglePair> swapped;
    for (const TrianglePair& pair : m_pairs) swapped.push_back({pair.second, pair.first});
    const Deepest ofSecond = deepestWithin(m_first, m_second, swapped);
    // The triangles of what is thick are its core.
    m_reachesIntoFirst = m_second.radius() == 0.0 && ofSecond.found && ofSecond.depth > m_sameTolerance;
    m_reachesIntoSecond = m_first.radius() == 0.0 && ofFirst.found && ofFirst.depth > m_sameTolerance;
    const bool isInside = ofFirst.found || ofSecond.found;
    if (isInside) takeDeeper(ofFirst, ofSecond);
    if (isInside) lookDeeper(std::max(ofFirst.depth, ofSecond.depth));
    if (!isInside && m_isInReach) m_meeting.depth = std::max(0.0, m_radius - m_coreDistance);
    m_meeting.isDeep = m_meeting.depth > m_tolerance;
  }

  /// Of what is as good as on the surface a deeper point is of no use.
  void lookDeeper(double known) {
    if (known <= m_sameTolerance) return;
    const Deepest ofFirst = deeperWithin(m_second, m_first, known);
    const Deepest ofSecond = deeperWithin(m_first, m_second, std::max(known, ofFirst.depth));
    if (ofFirst.found || ofSecond.found) takeDeeper(ofFirst, ofSecond);
  }

  /// Where all surfaces that bound what the two share lie on each other, no point of one lies in the other.
  void lookBesideFlushPlaces() {
    if (m_meeting.isDeep && passThrough()) return;  // nothing more is to be told
    if (m_flush.empty() || m_first.volume() == Volume::None || m_second.volume() == Volume::None) return;
    m_sides = lookBesideFlush(m_first, m_second, m_flush, m_sameTolerance);
    if (m_meeting.isDeep || m_sides.common.depth <= m_sameTolerance) return;
    m_meeting.isDeep = true;
    takeDeeper(m_sides.isOfSecond ? m_sides.common : Deepest(), m_sides.isOfSecond ? Deepest() : m_sides.common);
  }

  /// Whether a part of one reaches out of the other, by more than what is as good as within.
  [[nodiscard]] bool passThrough() const { return m_crossing > m_sameTolerance || m_passing > m_sameTolerance; }

  void findWithin() {
    if (!m_meeting.isDeep || passThrough()) return;
    // Around a cavity of one that the other fills, all of the other's surface is within, and not all of its volume.
    m_meeting.isFirstWithin = !m_reachesIntoFirst && !m_sides.isFirstOut && hasRoom(m_first, m_second) &&
                              isWithin(m_second, m_first, m_sameTolerance);
    m_meeting.isSecondWithin = !m_reachesIntoSecond && !m_sides.isSecondOut && hasRoom(m_second, m_first) &&
                               isWithin(m_first, m_second, m_sameTolerance);
  }

  /// Whether the core of what is thick comes nowhere so near to a surface around it that it sticks out.
  [[nodiscard]] bool hasRoom(const ExactPart& inner, const ExactPart& outer) const {
    return inner.radius() == 0.0 || outer.radius() > 0.0 || m_coreDistance >= inner.radius() - m_sameTolerance;
  }

  void takeDeeper(const Deepest& ofFirst, const Deepest& ofSecond) {
    const bool isFirst = ofFirst.found && (!ofSecond.found || ofFirst.depth >= ofSecond.depth);
    const Deepest& deepest = isFirst ? ofFirst : ofSecond;
    m_meeting.depth = deepest.depth + m_radius;
    if (m_meeting.depth <= m_tolerance) return;
    if (m_radius > 0.0 && deepest.depth <= m_tolerance) return;  // the core lies on the surface: measured there
    m_meeting.onFirst = isFirst ? deepest.point : deepest.surface;
    m_meeting.onSecond = isFirst ? deepest.surface : deepest.point;
    m_meeting.normal = directionOf(m_meeting.onSecond - m_meeting.onFirst);
    m_meeting.onFirst -= m_first.radius() * m_meeting.normal;
    m_meeting.onSecond += m_second.radius() * m_meeting.normal;
  }

  /// Surfaces that only meet have no direction between nearest points: of the normals of the triangles that meet, the
  /// one along which the two parts share least; else the line between their middles; else z.
  void guessNormal() {
    double least = std::numeric_limits<double>::infinity();
    for (const Point& normal : normalsOfMeeting()) {
      for (const Point& direction : {normal, Point(-normal)}) {
        const double shared = span(m_second, direction).second - span(m_first, direction).first;
        if (shared >= least - m_tolerance) continue;
        least = shared;
        m_meeting.normal = direction;
      }
    }
    if (m_meeting.normal.isZero()) m_meeting.normal = directionOf(middleOf(m_first.box()) - middleOf(m_second.box()));
    if (m_meeting.normal.isZero()) m_meeting.normal = Point::UnitZ();
  }

  [[nodiscard]] std::vector<Point> normalsOfMeeting() const {
    std::vector<Point> normals;
    const auto add = [&normals](const Corners& corners) {
      const Point normal = directionOf(normalOf(corners));
      if (!normal.isZero() && std::find(normals.begin(), normals.end(), normal) == normals.end()) {
        normals.push_back(normal);
      }
    };
    for (const TrianglePair& pair : m_pairs) {
      if (normals.size() >= kMostNormals) break;
      add(m_second.triangles()[pair.second]);
      add(m_first.triangles()[pair.first]);
    }
    return normals;
  }

  static constexpr std::size_t kMostLines = 128;  // that are looked at, with all triangles

  const ExactPart& m_first;
  const ExactPart& m_second;
  double m_tolerance;
  double m_sameTolerance;
  double m_radius;
  double m_passing = 0.0;   ///< How far segments of one pass through triangles of the other.
  double m_crossing = 0.0;  ///< How far triangles of the two pass through each other.
  double m_coreDistance = 0.0;
  bool m_isInReach = false;         ///< The distance of the cores is at most the sum of the radii.
  Point m_contact = Point::Zero();  ///< Of parts of which no triangles meet.
  bool m_reachesIntoFirst = false;  ///< The second's surface lies in the first, by more than what is as good as on it.
  bool m_reachesIntoSecond = false;
  std::vector<TrianglePair> m_pairs;
  std::vector<FlushPlace> m_flush;
  FlushSides m_sides;
  Meeting m_meeting;
};

}  // namespace

Meeting meet(const ExactPart& first, const ExactPart& second, const Tolerances& tolerances) {
  return Look(first, second, tolerances).take();
}

double boxDistance(const ExactPart& first, const ExactPart& second) {
  return std::max(0.0, boxGap(first.box(), second.box()) - first.radius() - second.radius());
}

}  // namespace allpairs::exact
