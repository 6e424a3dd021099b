// SPDX-License-Identifier: MIT
#include "Peer.h"

namespace allpairs::bench {

std::vector<Peer> packagedPeers() {
  std::vector<Peer> peers;
  peers.push_back(scalarLoopPeer());
  peers.push_back(nativeLoopPeer());
#ifdef ALLPAIRS_PEER_CGAL
  peers.push_back(cgalPeer());
#endif
#ifdef ALLPAIRS_PEER_EMBREE
  peers.push_back(embreePeer());
#endif
#ifdef ALLPAIRS_PEER_FCL
  peers.push_back(fclPeer());
#endif
#ifdef ALLPAIRS_PEER_BULLET
  peers.push_back(bulletPeer());
#endif
#ifdef ALLPAIRS_PEER_BOOST_GEOMETRY
  peers.push_back(boostGeometryPeer());
#endif
  return peers;
}

}  // namespace allpairs::bench
