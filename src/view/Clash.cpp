// SPDX-License-Identifier: MIT
#include "Clash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace allpairs::view {
namespace {

/// FNV-1a, 64 bits, from a seed.
std::uint64_t hashOf(const std::vector<std::string>& texts, std::uint64_t seed) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t hash = 0xcbf29ce484222325 ^ seed;
  for (const std::string& text : texts) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kPrime;
    hash = (hash ^ 0x100) * kPrime;  // the end of a text, which no byte can be
  }
  return hash;
}

/// How far two boxes reach into each other on an axis; below 0 it is a gap. Those that meet at infinity touch there.
double sharedExtent(const Box& a, const Box& b, std::size_t axis) {
  const double low = std::max(a.min[axis], b.min[axis]);
  const double high = std::min(a.max[axis], b.max[axis]);
  return low == high ? 0.0 : high - low;  // and not infinity minus infinity
}

/// How far boxes are apart, on the axis on which it is most; 0 where they are not.
double gapOf(const Clash& clash) {
  return std::max(0.0, -*std::min_element(clash.overlap.begin(), clash.overlap.end()));
}

/// Of shapes as worstFirst() has them. Of boxes what touches itself comes last: its boxes always share all.
bool comesBefore(const Clash& a, const Clash& b) {
  if (a.exact != nullptr && b.exact != nullptr) return isWorse(*a.exact, *b.exact);
  if (a.isSelf() != b.isSelf()) return b.isSelf();
  if (a.volume > b.volume || b.volume > a.volume) return a.volume > b.volume;
  return gapOf(a) < gapOf(b);
}

/// Of surfaces that meet all of it, and the deepest or the nearest points.
Box regionOf(const ExactPair& pair) {
  Box box = pair.contactBox;
  const bool hasPoints = pair.state != ExactState::Touching || isEmpty(box);
  if (hasPoints)
    box = merge(box, merge(Box{pair.pointOnFirst, pair.pointOnFirst}, Box{pair.pointOnSecond, pair.pointOnSecond}));
  return box;
}

std::string pointText(const collision::Vec3& p) {
  const auto [x, y, z] = coordinatesOf(p);
  return fmt::format("({}, {}, {})", x, y, z);
}

/// Why something is not known.
std::string openText(const ViewScene& scene, const Clash& clash) {
  if (clash.exact->isFirstOpen && clash.exact->isSecondOpen) return "the surfaces of both are not closed";
  return fmt::format("the surface of {} is not closed",
                     scene.name(clash.exact->isFirstOpen ? clash.first : clash.second));
}

std::string containedText(const ViewScene& scene, const Clash& clash) {
  const bool isFirst = clash.exact->isFirstInner;
  return fmt::format("{} lies wholly in {}, {} deep at {}.", scene.name(isFirst ? clash.first : clash.second),
                     scene.name(isFirst ? clash.second : clash.first), shortNumber(clash.exact->depth.value_or(0.0)),
                     pointText(allpairs::placeOf(*clash.exact)));
}

std::string gapText(const ExactPair& pair) {
  return fmt::format("{} apart, between {} and {}", shortNumber(pair.distance), pointText(pair.pointOnFirst),
                     pointText(pair.pointOnSecond));
}

std::string exactFinding(const ViewScene& scene, const Clash& clash) {
  const ExactPair& pair = *clash.exact;
  const std::string place = pointText(allpairs::placeOf(pair));
  switch (pair.state) {
    case ExactState::Duplicate:
      return fmt::format("The same shape in the same place, around {}.", place);
    case ExactState::Contained:
      return containedText(scene, clash);
    case ExactState::Clash:
      if (!pair.depth)
        return fmt::format("Surfaces cross at {}. How deep is not known: {}.", place, openText(scene, clash));
      return fmt::format("{} deep at {}, along {}.", shortNumber(*pair.depth), place, pointText(pair.normal));
    case ExactState::Touching:
      return fmt::format("They touch at {}.", place);
    case ExactState::Undecided:
      return fmt::format("Surfaces are {}. Whether one lies in the other is not known: {}.", gapText(pair),
                         openText(scene, clash));
    case ExactState::WithinClearance:
    case ExactState::Apart:
      return fmt::format("They are {}.", gapText(pair));
    case ExactState::NotExamined:
      break;
  }
  return clash.isSelf() ? "The model may touch itself." : "Their shapes could not be examined.";
}

/// A number with five digits at least, all before the point, and so many behind it where that is more.
std::string numberText(double value, int decimals) {
  constexpr int kFewestDigits = 5;
  constexpr int kMostDigits = 15;
  constexpr int kSmallestWithoutExponent = -6;
  if (value == 0.0) return "0";
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0.0 ? "∞" : "-∞";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  const int digits = std::clamp(exponent + 1 + decimals, kFewestDigits, kMostDigits);
  if (exponent < kSmallestWithoutExponent || exponent >= kMostDigits) return fmt::format("{:.{}g}", value, digits);
  std::string text = fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent));
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

using BodyPair = std::pair<std::uint32_t, std::uint32_t>;

/// The two bodies of a pair, in one order.
BodyPair bodiesOf(const ViewScene& scene, std::uint32_t first, std::uint32_t second) {
  return std::minmax({scene.bodyOf(first), scene.bodyOf(second)});
}

/// How many rows came out how: each as its worst pair.
ExactCounts countRows(const ViewScene& scene) {
  ExactCounts counts;
  std::set<BodyPair> rows;
  for (const std::size_t i : worstFirst(scene.exact)) {
    const auto& [first, second] = scene.frames.front().pairs[i];
    const bool isNew = scene.bodies.empty() || rows.insert(bodiesOf(scene, first, second)).second;
    if (isNew) ++counts.ofState[static_cast<std::size_t>(scene.exact[i].state)];
  }
  return counts;
}

/// Whichever of the two comes first, and whichever pair of their parts is the worst.
std::string guidOfRow(const ViewScene& scene, const Clash& clash) {
  std::vector<std::string> identities{identityOf(scene, clash.first), identityOf(scene, clash.second)};
  std::sort(identities.begin(), identities.end());
  return guidOf(identities);
}

/// Pairs, the worst first, as rows.
std::vector<Clash> rowsOf(const ViewScene& scene, std::vector<Clash> pairs) {
  if (scene.bodies.empty()) return pairs;
  std::vector<Clash> rows;
  std::map<BodyPair, std::size_t> places;
  for (Clash& pair : pairs) {
    const auto [place, isNew] = places.emplace(bodiesOf(scene, pair.first, pair.second), rows.size());
    (isNew ? rows : rows[place->second].inside).push_back(std::move(pair));
  }
  return rows;
}

}  // namespace

std::string identityOf(const ViewScene& scene, std::uint32_t model) {
  if (!scene.bodies.empty()) return scene.bodyIdentities[scene.bodies[model]];
  if (!scene.identities.empty()) return scene.identities[model];
  return scene.title + '\n' + scene.name(model) + '\n' + std::to_string(model);
}

Clash clashOf(const ViewScene& scene, std::size_t index) {
  const Pair& pair = scene.frames.front().pairs[index];
  const Box& a = scene.frames.front().boxes[pair.first];
  const Box& b = scene.frames.front().boxes[pair.second];
  Clash clash;
  clash.first = pair.first;
  clash.second = pair.second;
  if (scene.isExact) clash.exact = &scene.exact[index];
  clash.volume = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    clash.overlap[axis] = sharedExtent(a, b, axis);
    clash.volume *= std::max(0.0, clash.overlap[axis]);
  }
  if (std::any_of(clash.overlap.begin(), clash.overlap.end(), [](double extent) { return extent <= 0.0; })) {
    clash.volume = 0.0;  // and not infinity times zero
  }
  return clash;
}

std::string shortNumber(double value) { return numberText(value, 0); }

std::array<std::string, 3> coordinatesOf(const std::array<double, 3>& point) {
  constexpr double kNothing = 1e-9;
  constexpr int kHundredths = 2;
  const double largest = std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
  std::array<std::string, 3> texts;
  for (std::size_t i = 0; i < 3; ++i)
    texts[i] = numberText(std::abs(point[i]) <= kNothing * largest ? 0.0 : point[i], kHundredths);
  return texts;
}

std::string findingOf(const ViewScene& scene, const Clash& clash) {
  if (clash.exact != nullptr) return exactFinding(scene, clash);
  if (clash.isSelf()) return "The model may touch itself.";
  if (const auto axis = std::min_element(clash.overlap.begin(), clash.overlap.end()); *axis < 0.0)
    return fmt::format("The bounding boxes do not overlap, but lie within the distance: they are {} apart on {}.",
                       shortNumber(-*axis), "xyz"[axis - clash.overlap.begin()]);
  return fmt::format("The bounding boxes overlap by {}, {}, {}; they share a volume of {}.",
                     shortNumber(clash.overlap[0]), shortNumber(clash.overlap[1]), shortNumber(clash.overlap[2]),
                     shortNumber(clash.volume));
}

std::string beforeText(const Clash& clash) { return clash.before.empty() ? "" : " Before: " + clash.before + '.'; }

std::string headlineOf(const ViewScene& scene) {
  if (scene.isExact) return countText(countRows(scene));
  const std::size_t count = scene.frames.front().pairs.size();
  std::set<BodyPair> rows;
  for (const auto& [first, second] : scene.frames.front().pairs) rows.insert(bodiesOf(scene, first, second));
  std::string boxes = fmt::format("{} {} of boxes", count, count == 1 ? "pair" : "pairs");
  if (rows.size() == count) return boxes;
  return fmt::format("{} {} of bodies, {}", rows.size(), rows.size() == 1 ? "pair" : "pairs", boxes);
}

std::vector<Clash> clashesOf(const ViewScene& scene) {
  std::vector<Clash> clashes;
  for (std::size_t i = 0; i < scene.frames.front().pairs.size(); ++i) {
    if (!scene.isExact || scene.exact[i].state != ExactState::Apart) clashes.push_back(clashOf(scene, i));
  }
  std::stable_sort(clashes.begin(), clashes.end(), comesBefore);
  clashes = rowsOf(scene, std::move(clashes));
  for (std::size_t i = 0; i < clashes.size(); ++i) {
    Clash& clash = clashes[i];
    clash.number = i + 1;
    clash.guid = guidOfRow(scene, clash);
  }
  return clashes;
}

Box placeOf(const ViewScene& scene, const Clash& clash) {
  if (clash.exact != nullptr && clash.exact->state != ExactState::NotExamined) return regionOf(*clash.exact);
  const Box& a = scene.frames.front().boxes[clash.first];
  const Box& b = scene.frames.front().boxes[clash.second];
  Box result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = std::max(a.min[axis], b.min[axis]);
    const double high = std::min(a.max[axis], b.max[axis]);
    result.min[axis] = std::min(low, high);
    result.max[axis] = std::max(low, high);
  }
  return result;
}

std::string firstNameOf(const ViewScene& scene, const Clash& clash) {
  return clash.inside.empty() ? scene.name(clash.first) : scene.bodyName(clash.first);
}

std::string secondNameOf(const ViewScene& scene, const Clash& clash) {
  return clash.inside.empty() ? scene.name(clash.second) : scene.bodyName(clash.second);
}

std::string titleOf(const ViewScene& scene, const Clash& clash) {
  const std::string first = firstNameOf(scene, clash);
  const bool isOneBody =
      clash.isSelf() || (!clash.inside.empty() && scene.bodyOf(clash.first) == scene.bodyOf(clash.second));
  return isOneBody ? first + " with itself" : first + " and " + secondNameOf(scene, clash);
}

std::string guidOf(const std::vector<std::string>& texts) {
  const std::uint64_t high = hashOf(texts, 0);
  const std::uint64_t low = hashOf(texts, 0x9e3779b97f4a7c15);
  // Version 8, a number of the maker's own, and the usual variant (RFC 9562).
  return fmt::format("{:08x}-{:04x}-8{:03x}-{:04x}-{:012x}", high >> 32U, high >> 16U & 0xffffU, high & 0xfffU,
                     0x8000U | (low >> 48U & 0x3fffU), low & 0xffffffffffffU);
}

}  // namespace allpairs::view
