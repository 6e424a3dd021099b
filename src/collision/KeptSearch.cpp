// SPDX-License-Identifier: MIT
#include "KeptSearch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace allpairs::collision {
namespace {

/// A full search of fewer rows takes a few microseconds.
constexpr std::size_t kFewRows = 48;

/// If more than one box in this many has changed, a full search is faster.
constexpr std::size_t kShareOfChanged = 8;

/// Successive steps with few changes before the world is built, which costs two or three searches.
constexpr std::size_t kQuietSteps = 3;

/// If at least one in this many of all pairs of rows overlaps, a full search tests all pairs of boxes and is faster.
constexpr double kShareOfPairs = 20.0;

/// Ids reserved for models added later: one per this many rows.
constexpr std::size_t kShareOfFreeRows = 8;

}  // namespace

bool KeptSearch::isWorthIt(const ModelTable& models, const Settings& settings) {
  const bool follows = m_lookedAt + 1 == models.step() && settings == m_settings;
  const bool quiet = follows && models.changed().size() <= models.size() / kShareOfChanged;
  m_lookedAt = models.step();
  m_settings = settings;
  m_quietSteps = quiet ? m_quietSteps + 1 : 0;
  const auto n = static_cast<double>(models.size());
  return m_quietSteps >= kQuietSteps && models.size() >= kFewRows && std::isfinite(settings.distance) &&
         static_cast<double>(m_pairCount) * kShareOfPairs <= 0.5 * n * n;
}

bool KeptSearch::hasLastStepOf(const ModelTable& models) const {
  return m_worldStep + 1 == models.step() && m_worldRows == models.sizeBefore();
}

std::span<const Pair> KeptSearch::find(const ModelTable& models) {
  m_testsMade = 0;
  if (!m_world || m_worldSettings != m_settings || models.size() > m_room) {
    makeWorld(models);
  } else if (!hasLastStepOf(models)) {
    moveAll(models);
  } else {
    moveChanged(models);
  }
  m_worldStep = models.step();
  m_worldRows = models.size();
  m_pairCount = m_pairs.size();
  return m_pairs;
}

void KeptSearch::makeWorld(const ModelTable& models) {
  m_world.reset();
  m_room = models.size() + models.size() / kShareOfFreeRows;
  m_boxes.assign(m_room, kEmptyBox);
  m_properties.assign(m_room, {});
  for (std::size_t row = 0; row < models.size(); ++row) {
    m_boxes[m_room - 1 - row] = models.box(row);
    if (m_settings.addsContactDistances) m_properties[m_room - 1 - row].margin = models.contactDistances()[row];
  }
  m_ids.resize(m_room);
  WorldOptions options;
  options.distance = m_settings.distance;
  options.executor = m_settings.executor;
  options.stop = m_settings.stop;
  World world(std::move(options));
  world.add(BoxView(std::span<const Box>(m_boxes)), m_properties, m_ids);
  m_lastId = m_ids.back();
  m_world = std::move(world);
  m_worldSettings = m_settings;
  step();
}

void KeptSearch::moveAll(const ModelTable& models) {
  startMoving();
  for (std::size_t row = 0; row < models.size(); ++row) place(models, row);
  vacate(models.size(), m_room);
  move();
}

void KeptSearch::moveChanged(const ModelTable& models) {
  if (models.changed().empty() && models.size() == m_worldRows) return;
  startMoving();
  for (const std::uint32_t row : models.changed()) place(models, row);
  vacate(models.size(), m_worldRows);
  move();
}

void KeptSearch::startMoving() {
  m_ids.clear();
  m_boxes.clear();
  m_properties.clear();
}

void KeptSearch::place(const ModelTable& models, std::size_t row) {
  m_ids.push_back(idOf(row));
  m_boxes.push_back(models.box(row));
  if (!m_settings.addsContactDistances) return;
  m_properties.emplace_back();
  m_properties.back().margin = models.contactDistances()[row];
}

void KeptSearch::vacate(std::size_t begin, std::size_t end) {
  for (std::size_t row = begin; row < end; ++row) {
    m_ids.push_back(idOf(row));
    m_boxes.push_back(kEmptyBox);
    if (m_settings.addsContactDistances) m_properties.emplace_back();
  }
}

void KeptSearch::move() {
  m_world->move(m_ids, BoxView(std::span<const Box>(m_boxes)));
  if (m_settings.addsContactDistances) m_world->setProperties(m_ids, m_properties);
  step();
}

void KeptSearch::step() {
  const std::span<const Pair> found = m_world->step().pairs;
  m_pairs.resize(found.size());
  std::transform(found.rbegin(), found.rend(), m_pairs.begin(), [this](Pair pair) {
    return Pair{m_lastId - pair.second, m_lastId - pair.first};
  });
  m_testsMade = m_world->statistics().boxTests + m_world->statistics().groupTests;
}

}  // namespace allpairs::collision
