// SPDX-License-Identifier: MIT
#include "allpairs/Overlaps.h"

#include <algorithm>
#include <utility>

#include "allpairs/Error.h"

namespace allpairs {

struct Overlaps::State {
  OverlapOptions options;
  OverlapStatistics statistics;
  std::vector<Pair> pairs;
};

namespace {

// A placeholder of the search, one pair at a time, until the vectorised one takes its place behind the same interface.
bool passes(const BoxSet& a, std::size_t i, const BoxSet& b, std::size_t j, const OverlapOptions& options) {
  const double d = options.distance + a.margin(i) + b.margin(j);
  if (!overlap(a[i], b[j], d)) return false;
  if (options.region && (!overlap(a[i], *options.region, options.distance + a.margin(i)) ||
                         !overlap(b[j], *options.region, options.distance + b.margin(j)))) {
    return false;
  }
  return !options.filter.accept || options.filter.accept(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
}

}  // namespace

Overlaps::Overlaps(OverlapOptions options) : m_state(std::make_unique<State>()) { setOptions(std::move(options)); }
Overlaps::~Overlaps() = default;
Overlaps::Overlaps(Overlaps&&) noexcept = default;
Overlaps& Overlaps::operator=(Overlaps&&) noexcept = default;

const OverlapOptions& Overlaps::options() const noexcept { return m_state->options; }
void Overlaps::setOptions(OverlapOptions options) { m_state->options = std::move(options); }
const OverlapStatistics& Overlaps::statistics() const noexcept { return m_state->statistics; }

std::span<const Pair> Overlaps::find(const BoxSet& boxes) {
  std::vector<Pair>& pairs = m_state->pairs;
  pairs.clear();
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      if (passes(boxes, i, boxes, j, m_state->options)) pairs.push_back({i, j});
    }
  }
  if (m_state->options.order == Order::BySecond) {
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.second < b.second; });
  }
  const std::uint64_t n = boxes.size();
  m_state->statistics = {.pairs = pairs.size(), .boxTests = n == 0 ? 0 : n * (n - 1) / 2};
  return pairs;
}

std::span<const Pair> Overlaps::findBetween(const BoxSet& first, const BoxSet& second) {
  std::vector<Pair>& pairs = m_state->pairs;
  pairs.clear();
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    for (std::uint32_t j = 0; j < second.size(); ++j) {
      if (passes(first, i, second, j, m_state->options)) pairs.push_back({i, j});
    }
  }
  if (m_state->options.order == Order::BySecond) {
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.second < b.second; });
  }
  m_state->statistics = {.pairs = pairs.size(), .boxTests = first.size() * second.size()};
  return pairs;
}

std::uint64_t Overlaps::count(const BoxSet& boxes) { return find(boxes).size(); }
std::uint64_t Overlaps::countBetween(const BoxSet& first, const BoxSet& second) {
  return findBetween(first, second).size();
}

void Overlaps::stream(const BoxSet& boxes, PairVisitor visitor) { visitor(find(boxes)); }
void Overlaps::streamBetween(const BoxSet& first, const BoxSet& second, PairVisitor visitor) {
  visitor(findBetween(first, second));
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

std::span<const std::string_view> instructionSets() {
  static constexpr std::string_view kScalarOnly[] = {"SCALAR"};
  return kScalarOnly;
}

}  // namespace allpairs
