// SPDX-License-Identifier: MIT
#include "OwnSearches.h"

#include "allpairs/Overlaps.h"

namespace allpairs::bench {

namespace {

class FreshSearch final : public Search {
 public:
  explicit FreshSearch(const OverlapOptions& options) : m_overlaps(options) {}
  std::span<const Pair> find(std::span<const float> rows) override { return m_overlaps.find(BoxView::fromRows(rows)); }

 private:
  OverlapSearch m_overlaps;
};

class VectorSearch final : public Search {
 public:
  explicit VectorSearch(OverlapOptions options) : m_options(std::move(options)) {}
  std::span<const Pair> find(std::span<const float> rows) override {
    m_pairs = overlaps(BoxView::fromRows(rows), m_options);
    return m_pairs;
  }

 private:
  OverlapOptions m_options;
  std::vector<Pair> m_pairs;
};

class WarmSearch final : public Search {
 public:
  explicit WarmSearch(std::shared_ptr<OverlapSearch> overlaps) : m_overlaps(std::move(overlaps)) {}
  std::span<const Pair> find(std::span<const float> rows) override { return m_overlaps->find(BoxView::fromRows(rows)); }

 private:
  std::shared_ptr<OverlapSearch> m_overlaps;
};

class CountingSearch final : public Search {
 public:
  explicit CountingSearch(const OverlapOptions& options) : m_overlaps(options) {}
  std::span<const Pair> find(std::span<const float> rows) override {
    m_count = m_overlaps.count(BoxView::fromRows(rows));
    return {};
  }
  [[nodiscard]] std::uint64_t count() const noexcept override { return m_count; }

 private:
  OverlapSearch m_overlaps;
  std::uint64_t m_count = 0;
};

}  // namespace

MakeSearch freshSearches(const OverlapOptions& options) {
  return [options] { return std::make_unique<FreshSearch>(options); };
}

MakeSearch vectorSearches(const OverlapOptions& options) {
  return [options] { return std::make_unique<VectorSearch>(options); };
}

MakeSearch warmSearches(const OverlapOptions& options) {
  return [overlaps = std::make_shared<OverlapSearch>(options)] { return std::make_unique<WarmSearch>(overlaps); };
}

MakeSearch countingSearches(const OverlapOptions& options) {
  return [options] { return std::make_unique<CountingSearch>(options); };
}

}  // namespace allpairs::bench
