// SPDX-License-Identifier: MIT
#include "allpairs/collision/ExactPair.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "allpairs/Error.h"

namespace allpairs {
namespace {

void append(std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; }

/// What of the clashes is of a kind of its own.
std::string kindsOfClashes(const ExactCounts& counts) {
  std::string text;
  const std::uint64_t duplicates = counts.of(ExactState::Duplicate);
  if (duplicates != 0) append(text, grouped(duplicates) + (duplicates == 1 ? " duplicate" : " duplicates"));
  if (counts.of(ExactState::Contained) != 0) append(text, grouped(counts.of(ExactState::Contained)) + " contained");
  return text.empty() ? text : " (" + text + ")";
}

}  // namespace

std::string_view stateName(ExactState state) noexcept {
  constexpr std::array<std::string_view, kExactStates> kNames{"duplicate", "contained", "clash",        "touching",
                                                              "undecided", "clearance", "not-examined", "apart"};
  return kNames[static_cast<std::size_t>(state)];
}

collision::Vec3 placeOf(const ExactPair& pair) noexcept {
  if (pair.state == ExactState::Contained) return pair.isFirstInner ? pair.pointOnFirst : pair.pointOnSecond;
  const bool isArea = isContact(pair.state) && pair.depth.value_or(0.0) == 0.0 && !isEmpty(pair.contactBox);
  const collision::Vec3& a = isArea ? pair.contactBox.min : pair.pointOnFirst;
  const collision::Vec3& b = isArea ? pair.contactBox.max : pair.pointOnSecond;
  return {(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (a[2] + b[2]) / 2.0};
}

bool isWorse(const ExactPair& a, const ExactPair& b) noexcept {
  const auto key = [](const ExactPair& pair) {
    return std::tuple(pair.state, -pair.depth.value_or(0.0), pair.distance);
  };
  return key(a) < key(b);
}

std::vector<std::size_t> worstFirst(Span<const ExactPair> pairs) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [pairs](std::size_t a, std::size_t b) { return isWorse(pairs[a], pairs[b]); });
  return order;
}

std::uint64_t ExactCounts::clashes() const {
  return of(ExactState::Duplicate) + of(ExactState::Contained) + of(ExactState::Clash);
}

std::uint64_t ExactCounts::candidates() const {
  return std::accumulate(ofState.begin(), ofState.end(), std::uint64_t{0});
}

double ExactCounts::falseShare() const {
  const std::uint64_t examined = candidates() - of(ExactState::NotExamined);
  const std::uint64_t apart = of(ExactState::Apart) + of(ExactState::WithinClearance);
  return examined == 0 ? 0.0 : static_cast<double>(apart) / static_cast<double>(examined);
}

ExactCounts countStates(Span<const ExactPair> pairs) {
  ExactCounts counts;
  for (const ExactPair& pair : pairs) ++counts.ofState[static_cast<std::size_t>(pair.state)];
  return counts;
}

std::string countText(const ExactCounts& counts) {
  std::string text =
      grouped(counts.clashes()) + (counts.clashes() == 1 ? " clash" : " clashes") + kindsOfClashes(counts);
  const auto add = [&](ExactState state, const char* words) {
    if (counts.of(state) != 0) append(text, grouped(counts.of(state)) + words);
  };
  add(ExactState::Touching, " touching");
  add(ExactState::Undecided, " undecided");
  add(ExactState::WithinClearance, " within the clearance");
  add(ExactState::NotExamined, " not examined");
  add(ExactState::Apart, " apart");
  return text;
}

}  // namespace allpairs
