// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>
#include <sofa/type/Vec.h>

#include <vector>

namespace sofa::component::collision::geometry {

/// A level of boxes.
class CubeCollisionModel : public core::CollisionModel {
 public:
  SOFA_CLASS(CubeCollisionModel, core::CollisionModel);

  struct CubeData {
    type::Vec3 minBBox{};
    type::Vec3 maxBBox{};
    SReal coneAngle = 6.3;
  };

  void resize(Size size) override {
    CollisionModel::resize(size);
    m_cubes.resize(size);
  }
  void setParentOf(Index index, const type::Vec3& min, const type::Vec3& max) { m_cubes[index] = {min, max}; }
  void setConeAngle(SReal angle) { m_cubes[0].coneAngle = angle; }
  [[nodiscard]] const CubeData& getCubeData(Index index) const { return m_cubes[index]; }

 private:
  std::vector<CubeData> m_cubes;
};

/// One box of a level.
class Cube {
 public:
  explicit Cube(const core::CollisionElementIterator& element)
      : model(static_cast<CubeCollisionModel*>(element.getCollisionModel())), index(element.getIndex()) {}

  [[nodiscard]] const CubeCollisionModel::CubeData& data() const { return model->getCubeData(index); }

  CubeCollisionModel* model;
  Index index;
};

}  // namespace sofa::component::collision::geometry
