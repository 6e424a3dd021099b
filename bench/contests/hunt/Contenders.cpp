// SPDX-License-Identifier: MIT
#include "Contenders.h"

#include "allpairs/Overlaps.h"

namespace allpairs::bench {

namespace {

template <class T>
class OrderedOverlaps final : public SetSearch<T> {
 public:
  std::span<const Pair> find(const Sets<T>& sets) override {
    const BoxView first = BoxView::fromRows(sets.first);
    m_pairs = sets.areTwo ? overlaps(first, BoxView::fromRows(sets.second)) : overlaps(first);
    return m_pairs;
  }

  void clear() override { m_pairs = std::vector<Pair>(); }

 private:
  std::vector<Pair> m_pairs;
};

template <class T>
class KeptUnorderedFind final : public SetSearch<T> {
 public:
  std::span<const Pair> find(const Sets<T>& sets) override {
    const BoxView first = BoxView::fromRows(sets.first);
    return sets.areTwo ? m_search.find(first, BoxView::fromRows(sets.second)) : m_search.find(first);
  }

  void clear() override {}

 private:
  OverlapSearch m_search{{.order = Order::Unordered}};
};

}  // namespace

template <class T>
std::unique_ptr<SetSearch<T>> orderedOverlaps() {
  return std::make_unique<OrderedOverlaps<T>>();
}

template <class T>
std::unique_ptr<SetSearch<T>> keptUnorderedFind() {
  return std::make_unique<KeptUnorderedFind<T>>();
}

template std::unique_ptr<SetSearch<float>> orderedOverlaps<float>();
template std::unique_ptr<SetSearch<double>> orderedOverlaps<double>();
template std::unique_ptr<SetSearch<float>> keptUnorderedFind<float>();
template std::unique_ptr<SetSearch<double>> keptUnorderedFind<double>();

}  // namespace allpairs::bench
