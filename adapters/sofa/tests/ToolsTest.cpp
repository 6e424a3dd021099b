// SPDX-License-Identifier: MIT
// What the programs in tools/ do without a SOFA: read their arguments and write numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "../tools/Json.h"
#include "../tools/Settings.h"

namespace allpairs::tools {
namespace {

using ::testing::ElementsAre;

Settings read(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "program");
  return readSettings(static_cast<int>(arguments.size()), arguments.data());
}

std::string problemOf(const std::vector<const char*>& arguments) {
  try {
    (void)read(arguments);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "none";
}

TEST(SofaTools, ReadTheirArguments) {
  const Settings settings =
      read({"--steps", "3", "a.scn", "--plugin", "p", "--plugin", "q", "--data", "d", "--broad-phase", "b"});
  EXPECT_EQ(settings.scene, "a.scn");
  EXPECT_EQ(settings.steps, 3);
  EXPECT_THAT(settings.plugins, ElementsAre("p", "q"));
  EXPECT_THAT(settings.dataFolders, ElementsAre("d"));
  EXPECT_THAT(settings.broadPhases, ElementsAre("b"));
}

TEST(SofaTools, NameTheArgumentThatIsBad) {
  for (const char* bad : {"x", "12abc", "-5", "0", "", "1.5", "99999999999"}) {
    EXPECT_EQ(problemOf({"a.scn", "--steps", bad}),
              "--steps is '" + std::string(bad) + "', not a whole number of at least 1");
  }
  EXPECT_EQ(problemOf({"a.scn", "--steps"}), "--steps needs a value");
  EXPECT_EQ(problemOf({""}), "unknown argument ''");
  EXPECT_EQ(problemOf({"a.scn", "b.scn"}), "unknown argument 'b.scn'");
  EXPECT_EQ(problemOf({"--stp"}), "unknown argument '--stp'");
  EXPECT_EQ(problemOf({}), "which scene?");
}

TEST(SofaTools, WriteWhatIsNoNumberOfJsonAsAText) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(jsonNumber(0.1), "0.10000000000000001");
  EXPECT_EQ(jsonNumber(kInfinity), "\"inf\"");
  EXPECT_EQ(jsonNumber(-kInfinity), "\"-inf\"");
  EXPECT_EQ(jsonNumber(-std::numeric_limits<double>::quiet_NaN()), "\"nan\"");
  EXPECT_EQ(quoted("a\"\\\n"), R"("a\"\\?")");
}

}  // namespace
}  // namespace allpairs::tools
