// SPDX-License-Identifier: MIT
// The adapter compiles for a Bullet of double precision; Debian's, which the other tests run in, is of single
// precision.
#include <memory>
#include <type_traits>

#include "allpairs/bullet/BulletBroadphase.h"

namespace allpairs::test {

static_assert(std::is_same_v<btScalar, double>);

/// All of the class is compiled, since its functions are virtual.
std::unique_ptr<btBroadphaseInterface> makeDoubleBroadphase() { return std::make_unique<BulletBroadphase>(); }

}  // namespace allpairs::test
