// SPDX-License-Identifier: MIT
#include "allpairs/Overlaps.h"

#include <utility>

#include "Search.h"

namespace allpairs {

struct Overlaps::State : engine::InBlock {
  OverlapOptions options;
  engine::Search search;
};

Overlaps::Overlaps(OverlapOptions options) : m_state(std::make_unique<State>()) { setOptions(std::move(options)); }
Overlaps::~Overlaps() = default;
Overlaps::Overlaps(Overlaps&&) noexcept = default;
Overlaps& Overlaps::operator=(Overlaps&&) noexcept = default;

const OverlapOptions& Overlaps::options() const noexcept { return m_state->options; }
void Overlaps::setOptions(OverlapOptions options) { m_state->options = std::move(options); }
const OverlapStatistics& Overlaps::statistics() const noexcept { return m_state->search.statistics(); }

std::span<const Pair> Overlaps::find(const BoxSet& boxes) {
  return m_state->search.find({boxes, boxes, true}, m_state->options);
}

std::span<const Pair> Overlaps::findBetween(const BoxSet& first, const BoxSet& second) {
  return m_state->search.find({first, second, false}, m_state->options);
}

std::uint64_t Overlaps::count(const BoxSet& boxes) {
  return m_state->search.count({boxes, boxes, true}, m_state->options);
}

std::uint64_t Overlaps::countBetween(const BoxSet& first, const BoxSet& second) {
  return m_state->search.count({first, second, false}, m_state->options);
}

void Overlaps::stream(const BoxSet& boxes, PairVisitor visitor) {
  m_state->search.stream({boxes, boxes, true}, m_state->options, visitor);
}

void Overlaps::streamBetween(const BoxSet& first, const BoxSet& second, PairVisitor visitor) {
  m_state->search.stream({first, second, false}, m_state->options, visitor);
}

std::vector<Pair> overlaps(const BoxSet& boxes, const OverlapOptions& options) {
  Overlaps search(options);
  const std::span<const Pair> pairs = search.find(boxes);
  return {pairs.begin(), pairs.end()};
}

std::vector<Pair> overlapsBetween(const BoxSet& first, const BoxSet& second, const OverlapOptions& options) {
  Overlaps search(options);
  const std::span<const Pair> pairs = search.findBetween(first, second);
  return {pairs.begin(), pairs.end()};
}

std::uint64_t countOverlaps(const BoxSet& boxes, const OverlapOptions& options) {
  return Overlaps(options).count(boxes);
}

std::uint64_t countOverlapsBetween(const BoxSet& first, const BoxSet& second, const OverlapOptions& options) {
  return Overlaps(options).countBetween(first, second);
}

void streamOverlaps(const BoxSet& boxes, PairVisitor visitor, const OverlapOptions& options) {
  Overlaps(options).stream(boxes, visitor);
}

void streamOverlapsBetween(const BoxSet& first, const BoxSet& second, PairVisitor visitor,
                           const OverlapOptions& options) {
  Overlaps(options).streamBetween(first, second, visitor);
}

std::span<const std::string_view> instructionSets() { return engine::kernelNames(); }

}  // namespace allpairs
