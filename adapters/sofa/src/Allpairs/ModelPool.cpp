// SPDX-License-Identifier: MIT
#include <Allpairs/ModelPool.h>
#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/component/collision/geometry/LineCollisionModel.h>
#include <sofa/component/collision/geometry/PointCollisionModel.h>
#include <sofa/component/collision/geometry/SphereCollisionModel.h>
#include <sofa/component/collision/geometry/TetrahedronCollisionModel.h>
#include <sofa/component/collision/geometry/TriangleCollisionModel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace allpairs::plugin {
namespace {

namespace geometry = sofa::component::collision::geometry;
using sofa::defaulttype::Rigid3Types;
using sofa::defaulttype::Vec3Types;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Box kEverything{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

/// A model whose type is not known here: it may have rules of its own about whom it collides with, and is asked.
class AskingModel final : public collision::HostedModel {
 public:
  [[nodiscard]] bool canCollideWith(collision::CollisionModel* other) override {
    return hostOf(*this)->getLast()->canCollideWith(hostOf(*other)->getLast());
  }
};

/// Whether a type is one of SOFA's own, and no subclass: then sofa::core::CollisionModel::canCollideWith() is not
/// overridden, and its rule is also that of our models.
bool isPlainType(const std::type_info& type) {
  return type == typeid(geometry::TriangleCollisionModel<Vec3Types>) ||
         type == typeid(geometry::LineCollisionModel<Vec3Types>) ||
         type == typeid(geometry::PointCollisionModel<Vec3Types>) ||
         type == typeid(geometry::SphereCollisionModel<Vec3Types>) ||
         type == typeid(geometry::SphereCollisionModel<Rigid3Types>) ||
         type == typeid(geometry::TetrahedronCollisionModel) || type == typeid(geometry::CubeCollisionModel);
}

/// Whether the box is one that our layer takes as SOFA does: no NaN, and not reversed.
bool isProper(const Box& box) {
  return box.min[0] <= box.max[0] && box.min[1] <= box.max[1] && box.min[2] <= box.max[2];
}

void copyGroups(const std::set<int>& groups, collision::HostedModel& model) {
  const std::vector<int>& known = model.getGroups();
  if (std::equal(groups.begin(), groups.end(), known.begin(), known.end())) return;
  model.setGroups({groups.begin(), groups.end()});
}

}  // namespace

void ModelPool::clear() {
  m_plainUsed = 0;
  m_askingUsed = 0;
  m_firstBox = nullptr;
  m_anyOddRoot = false;
  m_anySelfCollision = false;
}

std::span<collision::HostedModel* const> ModelPool::add(std::span<sofa::core::CollisionModel* const> hosts) {
  readAll(hosts);
  m_added.clear();
  for (const Note& note : m_notes) {
    collision::HostedModel& model = takeFor(note);
    model.setHost(note.host);
    model.setOwner(note.owner);
    model.setSimulated(note.simulated);
    model.setSelfCollision(note.selfCollision);
    if (note.hasGroups || !model.getGroups().empty()) copyGroups(*note.groups, model);
    if (note.contactDistance != model.getContactDistance()) model.setContactDistance(note.contactDistance);
    model.setBox(note.box);
    m_anySelfCollision = m_anySelfCollision || note.selfCollision;
    m_added.push_back(&model);
  }
  return m_added;
}

/// SOFA's models are kilobytes each and lie far apart: a step mostly waits for memory. Short loops over several models let
/// the processor wait for all of them at once, and few enough of them that their pages are still known in the next loop.
void ModelPool::readAll(std::span<sofa::core::CollisionModel* const> hosts) {
  constexpr std::size_t kTogether = 16;
  m_notes.resize(hosts.size());
  for (std::size_t i = 0; i < hosts.size(); ++i) m_notes[i].host = hosts[i];
  const std::span<Note> notes = m_notes;
  for (std::size_t i = 0; i < notes.size(); i += kTogether) {
    read(notes.subspan(i, std::min(kTogether, notes.size() - i)));
  }
}

void ModelPool::read(std::span<Note> notes) {
  for (Note& note : notes) note.last = note.host->getLast();
  for (Note& note : notes) note.simulated = note.host->isSimulated();
  for (Note& note : notes) readRoot(note);
  for (Note& note : notes) note.selfCollision = note.last->getSelfCollision();
  for (Note& note : notes) note.hasDefaultRules = hasDefaultRules(*note.last);
  for (Note& note : notes) note.owner = note.last->getContext();
  for (Note& note : notes) note.groups = &note.last->getGroups();
  for (Note& note : notes) note.hasGroups = !note.groups->empty();
}

collision::HostedModel& ModelPool::takeFor(const Note& note) {
  if (note.hasDefaultRules) {
    if (m_plainUsed == m_plain.size()) m_plain.push_back(std::make_unique<collision::HostedModel>());
    return *m_plain[m_plainUsed++];
  }
  m_anySelfCollision = true;  // it may let itself
  if (m_askingUsed == m_asking.size()) m_asking.push_back(std::make_unique<AskingModel>());
  return *m_asking[m_askingUsed++];
}

bool ModelPool::hasDefaultRules(const sofa::core::CollisionModel& last) {
  const std::type_info& type = typeid(last);
  if (&type != m_lastType) {
    m_lastType = &type;
    m_lastTypeHasDefaultRules = isPlainType(type);
  }
  return m_lastTypeHasDefaultRules;
}

void ModelPool::readRoot(Note& note) {
  bool odd = true;
  if (typeid(*note.host) == typeid(geometry::CubeCollisionModel)) {
    const auto& cube = static_cast<const geometry::CubeCollisionModel&>(*note.host).getCubeData(0);
    for (sofa::Size axis = 0; axis < 3; ++axis) {
      note.box.min[axis] = static_cast<double>(cube.minBBox[axis]);
      note.box.max[axis] = static_cast<double>(cube.maxBBox[axis]);
    }
    note.contactDistance = static_cast<double>(note.host->getContactDistance());
    odd = !isProper(note.box) || !std::isfinite(note.contactDistance);
    if (m_firstBox == nullptr) m_firstBox = note.host;
  }
  if (!odd) return;
  note.box = kEverything;
  note.contactDistance = 0.0;
  m_anyOddRoot = true;
}

}  // namespace allpairs::plugin
