// SPDX-License-Identifier: MIT
#include "Clash.h"

#include <fmt/format.h>

#include <algorithm>

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

Clash clashOf(const ViewScene& scene, const Pair& pair) {
  const Box& a = scene.frames.front().boxes[pair.first];
  const Box& b = scene.frames.front().boxes[pair.second];
  Clash clash;
  clash.first = pair.first;
  clash.second = pair.second;
  clash.volume = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    clash.overlap[axis] = std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]);
    clash.volume *= std::max(0.0, clash.overlap[axis]);
  }
  if (std::any_of(clash.overlap.begin(), clash.overlap.end(), [](double extent) { return extent <= 0.0; })) {
    clash.volume = 0.0;  // and not infinity times zero
  }
  return clash;
}

/// What touches itself comes last: its boxes always share all.
bool comesBefore(const Clash& a, const Clash& b) {
  if (a.isSelf() != b.isSelf()) return b.isSelf();
  return a.volume > b.volume;
}

}  // namespace

std::vector<Clash> clashesOf(const ViewScene& scene) {
  std::vector<Clash> clashes;
  for (const Pair& pair : scene.frames.front().pairs) clashes.push_back(clashOf(scene, pair));
  std::stable_sort(clashes.begin(), clashes.end(), comesBefore);
  for (std::size_t i = 0; i < clashes.size(); ++i) {
    Clash& clash = clashes[i];
    clash.number = i + 1;
    clash.guid = guidOf({scene.title, scene.name(clash.first), scene.name(clash.second), std::to_string(clash.first),
                         std::to_string(clash.second)});
  }
  return clashes;
}

Box placeOf(const ViewScene& scene, const Clash& clash) {
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

std::string titleOf(const ViewScene& scene, const Clash& clash) {
  if (clash.isSelf()) return scene.name(clash.first) + " with itself";
  return scene.name(clash.first) + " and " + scene.name(clash.second);
}

std::string guidOf(const std::vector<std::string>& texts) {
  const std::uint64_t high = hashOf(texts, 0);
  const std::uint64_t low = hashOf(texts, 0x9e3779b97f4a7c15);
  // Version 8, a number of the maker's own, and the usual variant (RFC 9562).
  return fmt::format("{:08x}-{:04x}-8{:03x}-{:04x}-{:012x}", high >> 32U, high >> 16U & 0xffffU, high & 0xfffU,
                     0x8000U | (low >> 48U & 0x3fffU), low & 0xffffffffffffU);
}

}  // namespace allpairs::view
