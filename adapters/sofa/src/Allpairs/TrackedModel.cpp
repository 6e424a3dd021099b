// SPDX-License-Identifier: MIT
#include <Allpairs/TrackedModel.h>
#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/component/collision/geometry/LineCollisionModel.h>
#include <sofa/component/collision/geometry/PointCollisionModel.h>
#include <sofa/component/collision/geometry/SphereCollisionModel.h>
#include <sofa/component/collision/geometry/TetrahedronCollisionModel.h>
#include <sofa/component/collision/geometry/TriangleCollisionModel.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <typeinfo>

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
  using HostedModel::HostedModel;

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

/// Names the Data of a model that a broad phase reads, which SOFA shows to subclasses only.
struct DataOfModel : sofa::core::CollisionModel {
  static std::array<sofa::core::objectmodel::DDGNode*, 4> of(sofa::core::CollisionModel& root,
                                                             sofa::core::CollisionModel& last) {
    return {&(root.*(&DataOfModel::bSimulated)), &(root.*(&DataOfModel::d_contactDistance)),
            &(last.*(&DataOfModel::bSelfCollision)), &(last.*(&DataOfModel::group))};
  }
};

/// Whether the box is one that our layer takes as SOFA does: no NaN, and not reversed.
bool isProper(const Box& box) {
  return box.min[0] <= box.max[0] && box.min[1] <= box.max[1] && box.min[2] <= box.max[2];
}

}  // namespace

/// SOFA's models are kilobytes each and lie far apart: a step mostly waits for memory. Short loops let the processor
/// wait for several models at once.
void TrackedModel::read(std::span<TrackedModel* const> models) {
  for (TrackedModel* model : models) {
    if (!model->hasSameLevels()) model->readLevels();
  }
  for (TrackedModel* model : models) model->readNode();
  for (TrackedModel* model : models) {
    // A root that is no box may be of a user's type, whose isSimulated() need not look at SOFA's Data.
    if (model->isDirty() || !model->m_hasBox) model->readData();
    model->readBox();
  }
}

bool TrackedModel::hasSameLevels() const {
  return m_last && m_root->getNext() == m_belowRoot && m_last->getNext() == nullptr &&
         m_last->getPrevious() == m_aboveLast;
}

/// Finds the last level, and depends on the Data of both from now on. After an exception the next step does it again.
void TrackedModel::readLevels() {
  m_last.reset();
  const sofa::core::CollisionModel::SPtr last = m_root->getLast();
  m_belowRoot = m_root->getNext();
  m_aboveLast = last->getPrevious();
  const sofa::core::CollisionModel& root = *m_root;
  const sofa::core::CollisionModel& elements = *last;
  m_hasBox = typeid(root) == typeid(geometry::CubeCollisionModel);
  if (isPlainType(typeid(elements))) {
    m_model = std::make_unique<collision::HostedModel>(m_root.get());
  } else {
    m_model = std::make_unique<AskingModel>(m_root.get());
  }
  while (!getInputs().empty()) delInput(getInputs().back());
  for (sofa::core::objectmodel::DDGNode* data : DataOfModel::of(*m_root, *last)) addInput(data);
  m_last = last;
  m_lastAsComponent = last.get();
}

void TrackedModel::readData() {
  m_model->setSimulated(m_root->isSimulated());
  m_model->setSelfCollision(m_last->getSelfCollision());
  const std::set<int>& groups = m_last->getGroups();
  m_model->setGroups({groups.begin(), groups.end()});
  const auto distance = static_cast<double>(m_root->getContactDistance());
  m_hasContactDistance = std::isfinite(distance);
  m_model->setContactDistance(m_hasBox && m_hasContactDistance ? distance : 0.0);
  const collision::HostedModel& model = *m_model;
  m_mayCollideWithItself = m_last->getSelfCollision() || typeid(model) == typeid(AskingModel);
  cleanDirty();  // after all has been read: it is what makes SOFA report the next change
}

void TrackedModel::readNode() {
  const void* owner = m_lastAsComponent->getContext();
  if (m_model->getOwner() != owner) m_model->setOwner(owner);
}

void TrackedModel::readBox() {
  Box box = kEverything;
  if (m_hasBox) {
    const auto& cube = static_cast<const geometry::CubeCollisionModel&>(*m_root).getCubeData(0);
    for (sofa::Size axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<double>(cube.minBBox[axis]);
      box.max[axis] = static_cast<double>(cube.maxBBox[axis]);
    }
  }
  m_hasOddRoot = !m_hasBox || !m_hasContactDistance || !isProper(box);
  m_model->setBox(m_hasOddRoot ? kEverything : box);
}

}  // namespace allpairs::plugin
