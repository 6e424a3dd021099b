// SPDX-License-Identifier: MIT
#include "BoundingTreeBuilder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "allpairs/Error.h"

namespace allpairs::collision {
namespace {

std::size_t longestAxis(const Box& box) {
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (box.max[axis] - box.min[axis] > box.max[longest] - box.min[longest]) longest = axis;
  }
  return longest;
}

/// Twice the middle of a box on an axis; 0 where it is infinite both ways, because a NaN can't be sorted.
double middle(const Box& box, std::size_t axis) {
  const double sum = box.min[axis] + box.max[axis];
  return std::isnan(sum) ? 0.0 : sum;
}

}  // namespace

Box BoundingTreeBuilder::boxOf(std::size_t element) const {
  return m_swept ? m_model.elementSweptBox(element, m_dt) : m_model.elementBox(element);
}

NormalCone BoundingTreeBuilder::coneOf(std::size_t element) const {
  return m_swept ? m_model.elementSweptCone(element, m_dt) : m_model.elementCone(element);
}

Box BoundingTreeBuilder::checkedBoxOf(std::size_t element) const {
  const Box box = boxOf(element);
  if (hasNan(box)) {
    throw InvalidBox(element, m_model.describe() + ", element " + std::to_string(element) + ": its box has a NaN");
  }
  return box;
}

BoundingBoxModel::Node BoundingTreeBuilder::makeRoot() const {
  const std::size_t size = m_model.getSize();
  if (size > UINT32_MAX) throw InvalidArgument(m_model.describe() + ": more elements than 32 bits can number");
  BoundingBoxModel::Node root{checkedBoxOf(0), coneOf(0), 0, static_cast<std::uint32_t>(size)};
  for (std::size_t element = 1; element < size; ++element) {
    root.box = allpairs::merge(root.box, checkedBoxOf(element));
    root.cone.merge(coneOf(element));
  }
  return root;
}

void BoundingTreeBuilder::build(int maxDepth) {
  if (maxDepth < 0) throw InvalidArgument(m_model.describe() + ": a bounding tree of negative depth");
  m_model.m_treeIsCurrent = false;
  if (m_model.empty()) {
    link(m_model, 0);
    m_model.m_treeIsCurrent = true;
    return;
  }
  const BoundingBoxModel::Node root = makeRoot();
  level(m_model, 0).m_nodes.assign(1, root);
  m_model.m_rootBox = root.box;
  if (maxDepth > 0) {
    buildDeep(maxDepth);
  } else {
    m_model.m_levels.front()->m_elementOrder.clear();
    link(m_model, 1);
  }
  m_model.m_treeIsCurrent = true;
}

void BoundingTreeBuilder::setRoot(CollisionModel& model, const Box& box, const NormalCone& cone) {
  BoundingBoxModel& root = level(model, 0);
  root.m_nodes.assign(1, BoundingBoxModel::Node{box, cone, 0, static_cast<std::uint32_t>(model.getSize())});
  root.m_elementOrder.clear();
  model.m_rootBox = box;
  link(model, 1);
  model.m_treeIsCurrent = true;
}

void BoundingTreeBuilder::buildDeep(int maxDepth) {
  m_order = std::move(m_model.m_levels.back()->m_elementOrder);  // the memory of the last time
  m_order.resize(m_model.getSize());
  std::iota(m_order.begin(), m_order.end(), 0U);
  std::size_t depth = 0;
  while (depth < static_cast<std::size_t>(maxDepth) && level(m_model, depth).getSize() < m_order.size()) {
    BoundingBoxModel& children = level(m_model, depth + 1);  // may move the vector that holds the levels
    split(level(m_model, depth), children);
    ++depth;
  }
  link(m_model, depth + 1);
  m_model.m_levels.back()->m_elementOrder = std::move(m_order);
}

void BoundingTreeBuilder::split(BoundingBoxModel& parents, BoundingBoxModel& children) {
  children.m_nodes.clear();
  for (BoundingBoxModel::Node& node : parents.m_nodes) {
    const auto first = static_cast<std::uint32_t>(children.m_nodes.size());
    if (node.end - node.begin == 1) {
      addChild(children, node.begin, node.end);
    } else {
      const std::uint32_t half = partition(node);
      addChild(children, node.begin, half);
      addChild(children, half, node.end);
    }
    node.begin = first;
    node.end = static_cast<std::uint32_t>(children.m_nodes.size());
  }
}

void BoundingTreeBuilder::addChild(BoundingBoxModel& children, std::uint32_t begin, std::uint32_t end) const {
  BoundingBoxModel::Node node{boxOf(m_order[begin]), coneOf(m_order[begin]), begin, end};
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    node.box = allpairs::merge(node.box, boxOf(m_order[i]));
    node.cone.merge(coneOf(m_order[i]));
  }
  children.m_nodes.push_back(node);
}

/// Arranges a node's elements so that the lower half along its longest axis comes first; gives where the upper begins.
std::uint32_t BoundingTreeBuilder::partition(const BoundingBoxModel::Node& node) {
  const std::size_t axis = longestAxis(node.box);
  const std::uint32_t half = node.begin + (node.end - node.begin) / 2;
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const double middleOfA = middle(boxOf(a), axis);
    const double middleOfB = middle(boxOf(b), axis);
    return middleOfA != middleOfB ? middleOfA < middleOfB : a < b;  // by number where equal, the same on every system
  };
  const auto at = [this](std::uint32_t i) { return m_order.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(node.begin), at(half), at(node.end), before);
  std::sort(at(node.begin), at(half));
  std::sort(at(half), at(node.end));
  return half;
}

BoundingBoxModel& BoundingTreeBuilder::level(CollisionModel& model, std::size_t depth) {
  while (model.m_levels.size() <= depth) model.m_levels.push_back(std::make_unique<BoundingBoxModel>(model));
  return *model.m_levels[depth];
}

void BoundingTreeBuilder::link(CollisionModel& model, std::size_t levels) {
  model.m_levels.resize(levels);
  model.m_hasLevels = levels != 0;
  model.m_hasRoot = model.m_hasLevels;
  CollisionModel* previous = nullptr;
  for (const std::unique_ptr<BoundingBoxModel>& boxes : model.m_levels) {
    boxes->m_previous = previous;
    if (previous != nullptr) previous->m_next = boxes.get();
    previous = boxes.get();
  }
  model.m_previous = previous;
  if (previous != nullptr) previous->m_next = &model;
}

}  // namespace allpairs::collision
