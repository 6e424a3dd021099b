// SPDX-License-Identifier: MIT
#include <Allpairs/ModelPool.h>

#include <algorithm>
#include <array>
#include <utility>

namespace allpairs::plugin {
namespace {

/// So many that their waits for memory overlap, and so few that the pages of all are still known in the next loop.
constexpr std::size_t kReadAtOnce = 16;

}  // namespace

void ModelPool::begin() {
  m_used = 0;
  m_hasPlaces = false;
  m_firstBox = nullptr;
  m_anyOddRoot = false;
  m_anySelfCollision = false;
}

std::span<collision::HostedModel* const> ModelPool::add(std::span<sofa::core::CollisionModel* const> hosts) {
  m_added.clear();
  for (std::size_t i = 0; i < hosts.size(); i += kReadAtOnce) {
    addSome(hosts.subspan(i, std::min(kReadAtOnce, hosts.size() - i)));
  }
  return m_added;
}

void ModelPool::addSome(std::span<sofa::core::CollisionModel* const> hosts) {
  std::array<TrackedModel*, kReadAtOnce> models{};
  for (std::size_t i = 0; i < hosts.size(); ++i) models[i] = &next(*hosts[i]);
  TrackedModel::read({models.data(), hosts.size()});
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    TrackedModel& model = *models[i];
    if (m_firstBox == nullptr && model.hasBox()) m_firstBox = hosts[i];
    m_anyOddRoot = m_anyOddRoot || model.hasOddRoot();
    m_anySelfCollision = m_anySelfCollision || model.mayCollideWithItself();
    m_added.push_back(&model.model());
  }
}

void ModelPool::end() {
  m_models.resize(m_used);
  m_hasPlaces = false;
}

TrackedModel& ModelPool::next(sofa::core::CollisionModel& root) {
  if (m_used == m_models.size() || m_models[m_used]->root() != &root) bring(root);
  return *m_models[m_used++];
}

/// Puts the model of a root in the place of the next one; makes it if it wasn't in the last step, or came already.
void ModelPool::bring(sofa::core::CollisionModel& root) {
  if (!m_hasPlaces) notePlaces();
  const auto found = m_places.find(&root);
  const bool isKnown = found != m_places.end() && found->second >= m_used;
  const std::size_t place = isKnown ? found->second : m_models.size();
  if (!isKnown) m_models.push_back(std::make_unique<TrackedModel>(root));
  if (isKnown) m_places.erase(found);  // a root that was added twice gets a second object
  std::swap(m_models[m_used], m_models[place]);
  if (place != m_used) m_places[m_models[place]->root()] = place;
}

void ModelPool::notePlaces() {
  m_places.clear();
  for (std::size_t i = m_used; i < m_models.size(); ++i) m_places.emplace(m_models[i]->root(), i);
  m_hasPlaces = true;
}

}  // namespace allpairs::plugin
