// SPDX-License-Identifier: MIT
#include "MovingSearch.h"

namespace allpairs::bench {

std::vector<MovingContender> peerContenders() {
  std::vector<MovingContender> contenders;
#ifdef ALLPAIRS_PEER_BULLET
  addBulletContenders(contenders);
#endif
#ifdef ALLPAIRS_PEER_FCL
  addFclContenders(contenders);
#endif
#ifdef ALLPAIRS_PEER_EMBREE
  addEmbreeContenders(contenders);
#endif
#ifdef ALLPAIRS_PEER_PHYSX
  addPhysxContenders(contenders);
#endif
#ifdef ALLPAIRS_PEER_JOLT
  addJoltContenders(contenders);
#endif
  return contenders;
}

}  // namespace allpairs::bench
