// SPDX-License-Identifier: MIT
#include "world/WorldForest.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace allpairs::engine {
namespace {

std::uint64_t treeKeyOf(std::uint32_t number, bool isStatic) { return 2 * std::uint64_t{number} + (isStatic ? 1 : 0); }

}  // namespace

std::uint64_t WorldForest::update(const BoxStore& store, const WorldMembers& members, const BoxReader& reader,
                                  Executor& executor) {
  std::exchange(m_isWhole, false) ? follow(store, members) : plant(store, members);
  m_membership = store.membership();
  const auto countInexact = [this] {
    return std::count_if(m_dirty.begin(), m_dirty.end(), [this](std::uint32_t tree) { return !m_trees[tree].exact(); });
  };
  m_inexactTrees -= countInexact();
  std::atomic<std::uint64_t> builds = 0;
  const auto refresh = [&](std::uint32_t tree, Executor& with) {
    DynamicBvh& bvh = m_trees[tree];
    if (bvh.size() == 0) {
      bvh.clear();
      return;
    }
    if (!bvh.isBuildDue() && bvh.refit(m_homes, reader, with)) return;
    list(tree, store, members);
    bvh.build(m_homes, reader, with);
    ++builds;
  };
  if (m_dirty.size() <= 2) {  // A world: its threads share each of the two.
    for (const std::uint32_t tree : m_dirty) refresh(tree, executor);
  } else {
    cutIntoRuns(
        m_dirty, [this](std::uint32_t tree) { return m_trees[tree].size(); }, m_runs);
    executor.run(m_runs.size() - 1, [&](std::size_t run) {
      SerialExecutor serial;
      for (std::size_t i = m_runs[run]; i < m_runs[run + 1]; ++i) refresh(m_dirty[i], serial);
    });
  }
  m_inexactTrees += countInexact();
  for (const std::uint32_t tree : m_dirty) m_isDirty[tree] = 0;
  m_dirty.clear();
  m_isWhole = true;
  return builds;
}

std::uint32_t WorldForest::find(std::size_t world, bool isStatic) const noexcept {
  const std::size_t at = 2 * world + (isStatic ? 1 : 0);
  return at < m_treeOf.size() ? m_treeOf[at] : BoxHome::kNowhere;
}

const DynamicBvh& WorldForest::tree(std::size_t world, bool isStatic) const noexcept {
  const std::uint32_t found = find(world, isStatic);
  return found == BoxHome::kNowhere ? m_none : m_trees[found];
}

DynamicBvh& WorldForest::tree(std::size_t world, bool isStatic) noexcept {
  const std::uint32_t found = find(world, isStatic);
  return found == BoxHome::kNowhere ? m_none : m_trees[found];
}

std::uint32_t WorldForest::placeIn(const DynamicBvh& tree, BoxId id) const noexcept {
  const BoxHome home = id < m_homes.size() ? m_homes[id] : BoxHome();
  return home.tree != BoxHome::kNowhere && &m_trees[home.tree] == &tree ? home.place : BoxHome::kNowhere;
}

/// Makes all trees.
void WorldForest::plant(const BoxStore& store, const WorldMembers& members) {
  release();
  m_homes.resize(store.idBound());
  findTrees(members);
  for (BoxId id = 0; id < store.idBound(); ++id) enter(id, store, members);
}

/// Passes the changes of the store on to the trees.
void WorldForest::follow(const BoxStore& store, const WorldMembers& members) {
  if (m_membership != store.membership()) {
    m_homes.resize(std::max(m_homes.size(), store.idBound()));
    for (const BoxId id : store.resettled()) {
      BoxHome& home = m_homes[id];
      if (home.tree == BoxHome::kNowhere) continue;
      if (store.contains(id) && m_keys[home.tree] == treeKeyOf(store.worldOf(id), store.isStatic(id))) continue;
      m_trees[home.tree].remove(home.place);
      markDirty(home.tree);
      home = BoxHome();
    }
    findTrees(members);
    for (const BoxId id : store.resettled()) enter(id, store, members);
  }
  noteChanged(store);
}

/// Finds the trees of the worlds, of which some may have come; those without boxes are kept for others.
void WorldForest::findTrees(const WorldMembers& members) {
  m_treeOf.assign(2 * (members.everyWorld() + 1), BoxHome::kNowhere);
  m_unused.clear();
  for (std::size_t tree = 0; tree < m_trees.size(); ++tree) {
    if (m_trees[tree].size() == 0) {
      m_unused.push_back(static_cast<std::uint32_t>(tree));
      continue;
    }
    const std::size_t world = members.find(static_cast<std::uint32_t>(m_keys[tree] / 2));
    m_treeOf[2 * world + m_keys[tree] % 2] = static_cast<std::uint32_t>(tree);
  }
}

/// Adds a box of the store to its tree, unless it is there.
void WorldForest::enter(BoxId id, const BoxStore& store, const WorldMembers& members) {
  if (!store.contains(id) || m_homes[id].tree != BoxHome::kNowhere) return;
  const bool isStatic = store.isStatic(id);
  std::uint32_t& tree = m_treeOf[2 * members.worldOf(id) + (isStatic ? 1 : 0)];
  if (tree == BoxHome::kNowhere) {
    tree = takeUnused();
    m_keys[tree] = treeKeyOf(store.worldOf(id), isStatic);
  }
  m_homes[id].tree = tree;
  m_trees[tree].add(id);
  markDirty(tree);
}

/// A tree without boxes.
std::uint32_t WorldForest::takeUnused() {
  if (m_unused.empty()) {
    m_unused.push_back(static_cast<std::uint32_t>(m_trees.size()));
    m_trees.emplace_back(m_memory);
    m_keys.push_back(0);
    m_isDirty.push_back(0);
  }
  const std::uint32_t tree = m_unused.back();
  m_unused.pop_back();
  return tree;
}

/// Tells the trees which boxes have changed. If many have, all blocks are read again of trees that have some, without
/// checking which; most would be anyway.
void WorldForest::noteChanged(const BoxStore& store) {
  const bool areMany = store.stale().size() * kShareOfChange > store.size();
  if (areMany && !store.isNumbered()) {
    for (std::uint32_t tree = 0; tree < m_trees.size(); ++tree) markDirty(tree);
  } else {
    std::uint32_t last = BoxHome::kNowhere;  // Boxes of a world often follow each other.
    for (const BoxId id : store.stale()) {
      const BoxHome home = m_homes[id];
      if (home.place == BoxHome::kNowhere) continue;
      if (std::exchange(last, home.tree) != home.tree) markDirty(home.tree);
      if (!areMany) m_trees[home.tree].note(home.place);
    }
  }
  if (!areMany) return;
  for (const std::uint32_t tree : m_dirty) m_trees[tree].noteAll();
}

void WorldForest::markDirty(std::uint32_t tree) {
  if (std::exchange(m_isDirty[tree], std::uint8_t{1}) == 0) m_dirty.push_back(tree);
}

/// Has a tree that is to be built list all its boxes.
void WorldForest::list(std::uint32_t tree, const BoxStore& store, const WorldMembers& members) {
  m_trees[tree].clear();
  const bool isStatic = m_keys[tree] % 2 != 0;
  members.eachBox(members.find(static_cast<std::uint32_t>(m_keys[tree] / 2)), store, [&](BoxId id) {
    if (store.isStatic(id) == isStatic) m_trees[tree].add(id);
  });
}

}  // namespace allpairs::engine
