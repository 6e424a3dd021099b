// SPDX-License-Identifier: MIT
// The chain of levels above a model's elements.
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "SceneWorld.h"
#include "allpairs/Error.h"
#include "allpairs/collision/TriangleModel.h"

namespace allpairs::test {
namespace {

using namespace collision;

bool holds(const Box& outer, const Box& inner) { return isEmpty(inner) || merge(outer, inner) == outer; }

TEST(BoundingTree, AModelWithoutOneIsItsOwnFirstAndLast) {
  BoxModel model("m", cube(0, 0, 0));
  EXPECT_FALSE(model.hasBoundingTree());
  EXPECT_EQ(model.getFirst(), &model);
  EXPECT_EQ(model.getLast(), &model);
  EXPECT_EQ(model.getNext(), nullptr);
  EXPECT_EQ(model.getPrevious(), nullptr);
}

TEST(BoundingTree, TheRootIsTheFirstOfTheChainAndTheElementsAreTheLast) {
  BoxModel model("m", cube(0, 0, 0));
  model.computeBoundingTree();
  CollisionModel* root = model.getFirst();
  ASSERT_NE(root, &model);
  EXPECT_EQ(root->getSize(), 1U);
  EXPECT_EQ(root->getFirst(), root);
  EXPECT_EQ(root->getLast(), &model);
  EXPECT_EQ(root->getNext(), &model);
  EXPECT_EQ(model.getPrevious(), root);
  EXPECT_EQ(root->getPrevious(), nullptr);
  EXPECT_EQ(root->typeName(), "BoundingBoxModel");
}

TEST(BoundingTree, EveryLevelSharesTheModelsProperties) {
  BoxModel model("m", cube(0, 0, 0));
  model.computeBoundingTree();
  CollisionModel* root = model.getFirst();
  root->setSimulated(false);
  root->setGroups({4});
  root->setName("other");
  EXPECT_FALSE(model.isSimulated());
  EXPECT_EQ(model.getGroups(), std::vector<int>{4});
  EXPECT_EQ(model.getName(), "other");
}

TEST(BoundingTree, EachLevelBoundsTheNextAndTheLastBoundsEachElementOnce) {
  BoxModel model("m", toDouble(randomBoxes(300, 11)));
  model.computeBoundingTree();
  const Box root = model.getFirst()->elementBox(0);
  model.computeBoundingTree(5);
  EXPECT_EQ(model.getFirst()->elementBox(0), root);
  int levels = 0;
  for (CollisionModel* level = model.getFirst(); level->getNext() != &model; level = level->getNext()) {
    const auto& above = dynamic_cast<BoundingBoxModel&>(*level);
    const auto& below = dynamic_cast<BoundingBoxModel&>(*level->getNext());
    EXPECT_EQ(below.getPrevious(), &above);
    std::uint32_t next = 0;
    for (const BoundingBoxModel::Node& node : above.nodes()) {
      EXPECT_EQ(node.begin, next);
      for (; next < node.end; ++next) EXPECT_TRUE(holds(node.box, below.nodes()[next].box));
    }
    EXPECT_EQ(next, below.getSize());
    ++levels;
  }
  EXPECT_EQ(levels, 5);
  const auto& last = dynamic_cast<BoundingBoxModel&>(*model.getPrevious());
  std::set<std::uint32_t> seen;
  for (const BoundingBoxModel::Node& node : last.nodes()) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      EXPECT_TRUE(holds(node.box, model.elementBox(last.elementOrder()[i])));
      EXPECT_TRUE(seen.insert(last.elementOrder()[i]).second);
    }
  }
  EXPECT_EQ(seen.size(), model.getSize());
}

TEST(BoundingTree, ANodeIsSplitAtTheMiddleOfItsLongestAxisAndByNumberWhereElementsAreEqual) {
  const auto childrenOf = [](const std::vector<double>& places) {
    std::vector<Box> boxes;
    for (const double y : places) boxes.push_back(cube(0.0, y, 0.0));
    BoxModel model("m", boxes);
    model.computeBoundingTree(1);
    const Span<const std::uint32_t> order = dynamic_cast<BoundingBoxModel&>(*model.getPrevious()).elementOrder();
    return std::vector<std::uint32_t>(order.begin(), order.end());
  };
  EXPECT_EQ(childrenOf({5.0, 1.0, 4.0, 0.0, 3.0, 2.0}), (std::vector<std::uint32_t>{1, 3, 5, 0, 2, 4}));
  EXPECT_EQ(childrenOf({2.0, 0.0, 1.0, 1.0, 1.0, 0.0}), (std::vector<std::uint32_t>{1, 2, 5, 0, 3, 4}));
}

TEST(BoundingTree, ADeepTreeCanBecomeShallowAgain) {
  BoxModel model("m", toDouble(randomBoxes(30, 12)));
  model.computeBoundingTree(4);
  model.computeBoundingTree(0);
  EXPECT_EQ(model.getFirst()->getNext(), &model);
}

TEST(BoundingTree, InfiniteAndEmptyElementsCanBeSplit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Box space{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  BoxModel model("m", std::vector<Box>{space, kEmptyBox, space, cube(0, 0, 0), kEmptyBox});
  model.computeBoundingTree(6);
  EXPECT_EQ(model.getFirst()->elementBox(0), space);
}

TEST(BoundingTree, ANanInAnElementIsRefusedByModelAndElementAndTheTreeIsNotCurrent) {
  UserModel model({{0.0, 0.0, 0.0}, {1.0, std::numeric_limits<double>::quiet_NaN(), 1.0}}, 3);
  model.setName("broken");
  try {
    model.computeBoundingTree();
    FAIL();
  } catch (const InvalidBox& error) {
    EXPECT_NE(std::string(error.what()).find("model 'broken', element 0"), std::string::npos);
  }
  EXPECT_FALSE(model.hasBoundingTree());
}

TEST(BoundingTree, AModelWithoutElementsHasNoLevels) {
  BoxModel model("m", std::vector<Box>{cube(0, 0, 0)});
  model.computeBoundingTree();
  model.setBoxes({});
  model.computeBoundingTree();
  EXPECT_EQ(model.getFirst(), &model);
}

TEST(BoundingTree, AUsersModelMaySetItsRootItself) {
  class Ball : public CollisionModel {
   public:
    [[nodiscard]] std::size_t getSize() const override { return 1; }
    [[nodiscard]] Box elementBox(std::size_t /*index*/) const override { return cube(0, 0, 0); }
    void computeBoundingTree(int /*maxDepth*/) override { setRoot(cube(5, 5, 5)); }
  };
  Ball ball;
  ball.computeBoundingTree(3);
  EXPECT_TRUE(ball.hasBoundingTree());
  EXPECT_EQ(ball.getFirst()->elementBox(0), cube(5, 5, 5));
}

}  // namespace
}  // namespace allpairs::test
