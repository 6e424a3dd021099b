// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <typeindex>
#include <typeinfo>
#include <utility>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

/// What the rules read of a model for each pair, in half a cache line.
struct ModelRow {
  static constexpr std::uint8_t kSimulated = 1;
  static constexpr std::uint8_t kSelfCollision = 2;
  static constexpr std::uint8_t kDefaultRules = 4;  // canCollideWith() is not overridden
  static constexpr std::uint8_t kSelfPair = 8;

  CollisionModel* model = nullptr;  // as it was added
  const void* owner = nullptr;
  std::uint64_t groupBits = 0;
  std::uint32_t groups = 0;  // which of the table's group lists; 0 means none
  std::uint16_t type = 0;    // which of the table's root types
  std::uint8_t flags = 0;

  [[nodiscard]] bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
};

/// The models of a step as they were when they were added, in columns.
class ModelTable {
 public:
  ModelTable();

  /// Begins a step: the rows of the last one are compared with those that come. One without rows is none.
  void clear();

  /// The number of the step, from 1 on.
  [[nodiscard]] std::uint64_t step() const { return m_step; }

  /// How many rows the last step had.
  [[nodiscard]] std::size_t sizeBefore() const { return m_sizeBefore; }

  /// The rows whose box or contact distance is another than in the last step, or that it didn't have, ascending.
  [[nodiscard]] std::span<const std::uint32_t> changed() const { return {m_changed.data(), m_changedCount}; }

  /// Whether the last level of a model is of one of the library's own types, none of whose functions is overridden.
  [[nodiscard]] bool isOurs(const CollisionModel& last) {
    const std::type_info& type = typeid(last);
    if (&type != m_lastType.type) lookUpType(type);
    return m_lastType.ours;
  }

  /// Whether a model has no elements; without a virtual call if it is ours and has a root.
  [[nodiscard]] static bool isEmpty(const CollisionModel& last, bool ours) {
    return ours && last.m_treeIsCurrent ? !last.m_hasRoot : last.empty();
  }

  /// Notes a model; the caller has seen to it that it has a root.
  ///
  /// Bad input: a root box with a NaN throws InvalidBox, and the table stays as it was.
  void add(CollisionModel* model, bool ours, bool selfPair);

  [[nodiscard]] std::size_t size() const { return m_size; }
  [[nodiscard]] const ModelRow& row(std::size_t i) const { return m_rows[i]; }
  [[nodiscard]] const Box& box(std::size_t i) const { return m_boxes[i]; }
  [[nodiscard]] std::span<const Box> boxes() const { return {m_boxes.data(), m_size}; }

  /// The contact distance of each model.
  [[nodiscard]] std::span<const double> contactDistances() const { return {m_contactDistances.data(), m_size}; }
  [[nodiscard]] bool anyContactDistance() const { return m_largestContactDistance > 0.0; }
  [[nodiscard]] double largestContactDistance() const { return m_largestContactDistance; }

  /// Whether canCollideWith()'s own rule lets a collide with b, by what was noted of both.
  [[nodiscard]] bool letsCollide(const ModelRow& a, const ModelRow& b) const {
    if (a.owner == b.owner) return a.has(ModelRow::kSelfCollision);
    return (a.groupBits & b.groupBits) == 0 || !haveCommonGroup(a, b);
  }

  /// How many different types of root there are; BoundingBoxModel, always there, is number 0.
  [[nodiscard]] std::size_t typeCount() const { return m_rootTypes.size(); }

  /// Whether all models have the library's own rules and roots.
  [[nodiscard]] bool isPlain() const { return m_allOurs; }
  [[nodiscard]] bool anySelfPair() const { return m_anySelfPair; }

 private:
  struct KnownType {
    const std::type_info* type = nullptr;
    bool ours = false;
  };

  void grow();
  void noteChange(const Box& box, double contactDistance);
  void lookUpType(const std::type_info& type);
  [[nodiscard]] bool haveCommonGroup(const ModelRow& a, const ModelRow& b) const;
  [[nodiscard]] std::uint16_t rootTypeOf(const CollisionModel& model);
  [[nodiscard]] std::uint32_t noteGroups(const CollisionModel& last);

  std::uint64_t m_step = 1;
  std::size_t m_size = 0;  // of the columns, which are as long as they ever were
  std::size_t m_sizeBefore = 0;
  std::size_t m_changedCount = 0;
  std::vector<ModelRow> m_rows;
  std::vector<Box> m_boxes;
  std::vector<double> m_contactDistances;
  std::vector<std::uint32_t> m_changed;
  std::vector<std::shared_ptr<const std::vector<int>>> m_groupLists;
  std::vector<std::type_index> m_rootTypes;
  KnownType m_lastType;
  double m_largestContactDistance = 0.0;
  bool m_allOurs = true;
  bool m_anySelfPair = false;
};

}  // namespace allpairs::collision
