// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace allpairs::internal {

/// A number for a set of pairs that others get only by a chance of 1 to 2^64, whatever their order is.
struct PairDigest {
  std::size_t count = 0;
  std::uint64_t sum = 0;

  void add(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
    ++count;
    sum += valueOf(a, b);
  }
  void remove(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
    --count;
    sum -= valueOf(a, b);
  }
  friend bool operator==(const PairDigest& a, const PairDigest& b) { return a.count == b.count && a.sum == b.sum; }

 private:
  static std::uint64_t valueOf(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
    constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15U;
    const std::hash<const btBroadphaseProxy*> hash;
    const std::uint64_t product = (hash(a) + kOdd) * (hash(b) + kOdd);
    return (product ^ (product >> 32U)) * kOdd;
  }
};

}  // namespace allpairs::internal
