// SPDX-License-Identifier: MIT
#include <utility>

#include "QueryContest.h"
#include "allpairs/World.h"

namespace allpairs::bench {
namespace {

double numberOf(BoxId id) { return static_cast<double>(id); }
double numberOf(const SweepHit& hit) { return hit.t; }
double numberOf(const Neighbor& neighbor) { return neighbor.distance; }

Box boxAt(const QueryScene& scene, std::size_t i) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = static_cast<double>(scene.boxes[6 * i + axis]);
    box.max[axis] = static_cast<double>(scene.boxes[6 * i + 3 + axis]);
  }
  return box;
}

/// A world, asked in batches or one query after the other.
class WorldIndex final : public QueryIndex {
 public:
  WorldIndex(const QueryScene& scene, bool inBatches) : m_inBatches(inBatches) {
    static_cast<void>(m_world.add(BoxView::fromRows(std::span<const float>(scene.rows))));
    static_cast<void>(m_world.step());
  }

  [[nodiscard]] bool answers(QueryKind kind) const override { return m_inBatches || kind != QueryKind::AllHits; }

  void run(QueryKind kind, const QueryScene& scene) override {
    m_kind = kind;
    m_inBatches ? runBatch(scene) : runEach(scene);
  }

  void collect(Answers& answers) const override {
    if (!m_inBatches) {
      answers = m_answers;
    } else if (m_kind == QueryKind::FirstHit) {
      for (const SweepHit& hit : m_first) {
        answers.numbers.push_back(hit.t);
        answers.ends.push_back(answers.numbers.size());
      }
    } else {
      collectLists(answers);
    }
  }

 private:
  void runBatch(const QueryScene& scene) {
    m_first.resize(scene.rays.size());
    switch (m_kind) {
      case QueryKind::Overlapping:
        m_ids = m_world.findOverlapping(BoxView::fromRows(std::span<const float>(scene.boxes)));
        break;
      case QueryKind::FirstHit:
        m_world.findFirst(std::span<const Ray>(scene.rays), m_first);
        break;
      case QueryKind::AllHits:
        m_hits = m_world.findAll(std::span<const Ray>(scene.rays));
        break;
      case QueryKind::Nearest1:
      case QueryKind::Nearest8:
        m_near = m_world.findNearest(std::span<const std::array<double, 3>>(scene.points), neighbours());
        break;
    }
  }

  void runEach(const QueryScene& scene) {
    m_answers.clear();
    for (std::size_t i = 0; i < scene.rays.size(); ++i) {
      if (m_kind == QueryKind::Overlapping) {
        take<BoxId>(m_world.findOverlapping(boxAt(scene, i)));
      } else if (m_kind == QueryKind::FirstHit) {
        const SweepHit hit = m_world.findFirst(scene.rays[i]);
        take(std::span<const SweepHit>(&hit, 1));
      } else {
        take<Neighbor>(m_world.findNearest(scene.points[i], neighbours()));
      }
    }
  }

  template <class T>
  void take(std::span<const T> values) {
    for (const T& value : values) m_answers.numbers.push_back(numberOf(value));
    m_answers.ends.push_back(m_answers.numbers.size());
  }

  template <class T>
  static void collect(const ResultLists<T>& lists, Answers& answers) {
    for (const T& value : lists.values) answers.numbers.push_back(numberOf(value));
    answers.ends.assign(lists.offsets.begin() + 1, lists.offsets.end());
  }

  void collectLists(Answers& answers) const {
    if (m_kind == QueryKind::Overlapping) return collect(m_ids, answers);
    if (m_kind == QueryKind::AllHits) return collect(m_hits, answers);
    collect(m_near, answers);
  }

  [[nodiscard]] std::size_t neighbours() const { return m_kind == QueryKind::Nearest1 ? 1 : 8; }

  bool m_inBatches;
  QueryKind m_kind = QueryKind::Overlapping;
  World m_world;
  ResultLists<BoxId> m_ids;
  ResultLists<SweepHit> m_hits;
  ResultLists<Neighbor> m_near;
  std::vector<SweepHit> m_first;
  Answers m_answers;
};

}  // namespace

void addOwnIndices(const QueryScene& scene, std::vector<QueryContender>& contenders) {
  contenders.push_back({"Allpairs", "in a batch", std::make_unique<WorldIndex>(scene, true)});
  contenders.push_back({"Allpairs", "one by one", std::make_unique<WorldIndex>(scene, false)});
}

}  // namespace allpairs::bench
