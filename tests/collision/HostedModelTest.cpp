// SPDX-License-Identifier: MIT
// Models that stand for those of another system.
#include "allpairs/collision/HostedModel.h"

#include <limits>

#include "Fixture.h"

namespace allpairs::test {
namespace {

using collision::HostedModel;

/// Asks the other system, here a flag, whether it may collide.
class AskedModel : public HostedModel {
 public:
  using HostedModel::HostedModel;
  [[nodiscard]] bool canCollideWith(collision::CollisionModel* /*other*/) override {
    return *static_cast<const bool*>(host());
  }
};

class HostedModels : public BroadPhaseTest {
 protected:
  template <class Model = HostedModel>
  Model& addHosted(const Box& box, void* host = nullptr) {
    auto model = std::make_unique<Model>(host);
    model->setOwner(model.get());
    model->setBox(box);
    m_models.push_back(model.get());
    Model& added = *model;
    m_others.push_back(std::move(model));
    return added;
  }
};

TEST_F(HostedModels, ArePairedByTheirBoxesAndFlagsWithModelsOfTheLibrary) {
  addHosted(unitBoxAt(0.0)).setSelfCollision(true);
  add(unitBoxAt(0.5));
  addHosted(unitBoxAt(1.25));
  addHosted(unitBoxAt(9.0));
  EXPECT_EQ(detect(), (Numbers{{0, 0}, {1, 0}, {2, 1}}));
}

TEST_F(HostedModels, MoveWithTheirBoxesFromStepToStep) {
  HostedModel& moving = addHosted(unitBoxAt(0.0));
  addHosted(unitBoxAt(5.0));
  EXPECT_EQ(detect(), Numbers{});
  moving.setBox(unitBoxAt(4.5));
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(HostedModels, AddTheirContactDistancesToTheMethods) {
  HostedModel& wide = addHosted(unitBoxAt(0.0));
  addHosted(unitBoxAt(1.5));
  wide.setContactDistance(0.5);
  wide.setBox(unitBoxAt(0.0));
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(HostedModels, MayAskTheirHostWhetherTheyCollide) {
  bool allowed = false;
  addHosted<AskedModel>(unitBoxAt(0.0), &allowed);
  add(unitBoxAt(0.0));
  EXPECT_EQ(detect(), Numbers{});
  allowed = true;
  EXPECT_EQ(detect(), (Numbers{{0, 0}, {1, 0}}));
}

TEST_F(HostedModels, RememberTheirHost) {
  int body = 0;
  HostedModel model;
  EXPECT_EQ(model.host(), nullptr);
  model.setHost(&body);
  EXPECT_EQ(model.host(), &body);
}

TEST_F(HostedModels, AreTheirOwnRootsUntilABoundingTreeIsComputed) {
  HostedModel& model = addHosted(unitBoxAt(0.0));
  HostedModel& other = addHosted(unitBoxAt(0.5));
  EXPECT_EQ(model.getFirst(), &model);
  EXPECT_EQ(model.typeKey(), model.rootTypeKey());
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
  model.computeBoundingTree(3);
  EXPECT_NE(model.getFirst(), &model);
  EXPECT_EQ(model.typeKey(), std::type_index(typeid(HostedModel)));
  EXPECT_EQ(model.getFirst()->elementBox(0), unitBoxAt(0.0));
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
  model.setBox(unitBoxAt(5.0));
  EXPECT_EQ(model.getFirst()->elementBox(0), unitBoxAt(5.0));
  EXPECT_EQ(detect(), Numbers{});
  other.setContactDistance(4.0);  // which invalidates its box: the broad phase computes the tree
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
  EXPECT_EQ(other.elementBox(0), unitBoxAt(0.5));
}

TEST_F(HostedModels, RefuseABoxWithANan) {
  HostedModel model;
  EXPECT_THROW(model.setBox({{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, {1.0, 1.0, 1.0}}), InvalidBox);
}

}  // namespace
}  // namespace allpairs::test
