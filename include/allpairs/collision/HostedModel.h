// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

/// A proxy for a model of another system: its box is set from outside, and it keeps a pointer to that model.
///
/// An adapter uses it to pass another system's models to the broad phase: flags, groups, owner and distance with the
/// setters of CollisionModel, the box with setBox(). A subclass may override canCollideWith() to ask the other system.
/// Geometry:  a closed box; min > max on an axis means empty; infinite bounds are allowed.
/// Bad input: a NaN in the box throws InvalidBox.
class HostedModel : public CollisionModel {
 public:
  explicit HostedModel(void* host = nullptr) : m_host(host) {}

  /// The model that this is a proxy for, as it was set. Never dereferenced.
  [[nodiscard]] void* host() const { return m_host; }
  void setHost(void* host) { m_host = host; }

  /// The root box of a step. Set it after the contact distance, which invalidates the box.
  void setBox(const Box& box) { setOwnRoot(box); }

  [[nodiscard]] std::size_t getSize() const override { return 1; }
  [[nodiscard]] Box elementBox(std::size_t /*index*/) const override { return rootBox(); }
  [[nodiscard]] std::string_view typeName() const override { return "HostedModel"; }

  /// That of a root box while the model is its own root; its type once computeBoundingTree() has put a level above it.
  [[nodiscard]] std::type_index typeKey() const override {
    return getFirst() == this ? rootTypeKey() : CollisionModel::typeKey();
  }

 private:
  void* m_host = nullptr;
};

}  // namespace allpairs::collision
