// SPDX-License-Identifier: MIT
// The work for many inputs grows as they do. Allocations are counted: they grow as work does, and are the same each
// time.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "ViewScene.h"
#include "allpairs/scene/Scene.h"
#include "cli/Options.h"
#include "input/Inputs.h"
#include "support/AllocationCount.h"
#include "support/TempFolder.h"
#include "view/Bodies.h"

namespace allpairs::test {
namespace {

struct Allocations {
  std::size_t reading = 0;
  std::size_t grouping = 0;
};

/// What it takes to read so many files of two objects each, and to name them as bodies.
Allocations allocationsFor(std::size_t files) {
  const TempFolder folder;
  app::InputSettings settings;
  const std::string object = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
  for (std::size_t i = 0; i < files; ++i) {
    const std::string name = "a part with a long name " + std::to_string(i) + ".obj";
    settings.paths.push_back(folder.write(name, "o wheel\n" + object + "o axle\n" + object));
  }
  const std::size_t before = allocationCount();
  const app::Inputs inputs = app::readInputs(settings);
  const std::size_t read = allocationCount();
  view::ViewScene shown;
  app::addBodies(std::get<scene::Scene>(inputs), app::Grouping::File, shown);
  const std::size_t grouped = allocationCount();
  EXPECT_EQ(shown.bodyNames.size(), files);
  return {.reading = read - before, .grouping = grouped - read};
}

TEST(ManyInputs, TakeWorkInProportion) {
  static_cast<void>(allocationsFor(1));  // what is made once
  const Allocations few = allocationsFor(50);
  const Allocations many = allocationsFor(400);
  EXPECT_LT(many.reading, 10 * few.reading) << "8 times as many files";
  EXPECT_LT(many.grouping, 10 * few.grouping);
}

}  // namespace
}  // namespace allpairs::test
