// SPDX-License-Identifier: MIT
#include <type_traits>
#include <utility>

#include "Peer.h"
#include "SetPeer.h"

namespace allpairs::bench {

namespace {

/// A peer that searches one set of float32, as a search after the other.
class OneSetSearch final : public SetSearch<float> {
 public:
  explicit OneSetSearch(std::function<std::unique_ptr<Search>()> make) : m_make(std::move(make)) {}

  std::span<const Pair> find(const Sets<float>& sets) override {
    clear();
    m_search = m_make();
    return m_search->find(sets.first);
  }

  void clear() override { m_search.reset(); }

 private:
  std::function<std::unique_ptr<Search>()> m_make;
  std::unique_ptr<Search> m_search;
};

/// The packaged peers; the scalar loop is not one of them here, since there is a plain one for all sets.
std::vector<SetPeer<float>> peersOfOneSet() {
  std::vector<SetPeer<float>> peers;
  for (const Peer& peer : packagedPeers()) {
    if (peer.name == scalarLoopPeer().name) continue;
    SetPeer<float>& added = peers.emplace_back(SetPeer<float>{peer.name, {}});
    for (const Setting& setting : peer.settings) {
      added.settings.push_back({setting.name, [make = setting.make] { return std::make_unique<OneSetSearch>(make); }});
    }
  }
  return peers;
}

template <class T>
std::vector<SetPeer<T>> peersOfAnySets() {
  std::vector<SetPeer<T>> peers;
#ifdef ALLPAIRS_PEER_CGAL
  peers.push_back(cgalOfSets<T>());
#endif
#ifdef ALLPAIRS_PEER_BOOST_GEOMETRY
  peers.push_back(boostGeometryOfSets<T>());
#endif
#ifdef ALLPAIRS_PEER_FCL
  peers.push_back(fclOfSets<T>());
#endif
  return peers;
}

/// Peers that search two sets of float32 and nothing in float64.
std::vector<SetPeer<float>> peersOfTwoSets() {
  std::vector<SetPeer<float>> peers = peersOfAnySets<float>();
#ifdef ALLPAIRS_PEER_EMBREE
  peers.push_back(embreeOfTwoSets());
#endif
#ifdef ALLPAIRS_PEER_BULLET
  peers.push_back(bulletOfTwoSets());
#endif
  return peers;
}

/// Those that have to be built from their own sources, whatever the sets are.
template <class T>
void addPeersWithoutPackages([[maybe_unused]] std::vector<SetPeer<T>>& peers) {
  if constexpr (std::is_same_v<T, float>) {
#ifdef ALLPAIRS_PEER_PHYSX
    peers.push_back(physxOfSets());
#endif
#ifdef ALLPAIRS_PEER_TINYBVH
    peers.push_back(tinyBvhOfSets());
#endif
  }
#ifdef ALLPAIRS_PEER_BVH
  peers.push_back(bvhOfSets<T>());
#endif
#ifdef ALLPAIRS_PEER_ARBORX
  peers.push_back(arborxOfSets<T>());
#endif
}

}  // namespace

template <class T>
std::vector<SetPeer<T>> setPeers(bool areTwo) {
  std::vector<SetPeer<T>> peers;
  if constexpr (std::is_same_v<T, float>) {
    peers = areTwo ? peersOfTwoSets() : peersOfOneSet();
  } else {
    (void)areTwo;
    peers = peersOfAnySets<T>();
  }
  addPeersWithoutPackages(peers);
  peers.insert(peers.begin(), plainSweepOfSets<T>());
  peers.insert(peers.begin(), plainLoopOfSets<T>());
  return peers;
}

template std::vector<SetPeer<float>> setPeers<float>(bool);
template std::vector<SetPeer<double>> setPeers<double>(bool);

}  // namespace allpairs::bench
