// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <cstddef>
#include <cstdint>

namespace allpairs::bench {

/// A corner of a box, from three numbers of its row.
inline btVector3 corner(const float* row) { return {row[0], row[1], row[2]}; }

inline btDbvtVolume volumeOf(const float* row) { return btDbvtVolume::FromMM(corner(row), corner(row + 3)); }

/// Bullet keeps a pointer for the user; it holds the number of the box.
inline void* pointerOf(std::size_t number) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(number)); }
inline std::uint32_t numberOf(const void* pointer) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer));
}

}  // namespace allpairs::bench
