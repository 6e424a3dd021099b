// SPDX-License-Identifier: MIT
// The products of an IFC are called what the file calls them, blanks and letters of all alphabets included.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "allpairs/scene/ReadInput.h"
#include "support/IfcText.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// What the wall and the column are called where the wall's name stands so in the file, quotes included.
std::string namesWith(const std::string& name) {
  std::string text = kIfc;
  text.replace(text.find("'wall'"), 6, name);
  const TempFolder folder;
  const scene::Scene scene = scene::readInput(folder.write("a.ifc", text));
  return scene.models.at(0)->getName() + ", " + scene.models.at(1)->getName();
}

TEST(IfcNames, AreDecoded) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"wall 1 north", "wall 1 north"},
      {"it''s", "it's"},
      {R"(a\\b)", R"(a\b)"},
      {R"(T\X\FCr)", "T\u00fcr"},
      {R"(T\S\|r)", "T\u00fcr"},
      {R"(\X2\00E900DF\X0\ x)", "\u00e9\u00df x"},
      {R"(\X2\65E5672C\X0\)", "\u65e5\u672c"},
      {R"(\X2\D83DDE00\X0\)", "\U0001F600"},
      {R"(\X4\0001F600\X0\)", "\U0001F600"},
      {"T\u00fcr", "T\u00fcr"},
  };
  for (const auto& [text, decoded] : cases) EXPECT_EQ(namesWith('\'' + text + '\''), decoded + ", column") << text;
}

TEST(IfcNames, StayAsTheyAreWhereNothingIsEncoded) {
  // (Where an encoding is broken, Assimp refuses the file.)
  for (const std::string text : {R"(C:\Temp)", R"(\X\G0)", R"(\)", R"(\S\)", R"(50 % & <b>)"}) {
    EXPECT_EQ(namesWith('\'' + text + '\''), text + ", column");
  }
}

TEST(IfcNames, MayBeMissingAndLieAmongBlanksAndCommasAndWhatLooksLikeAnother) {
  EXPECT_EQ(namesWith("$"), "IfcWallStandardCase, column");
  EXPECT_EQ(namesWith("''"), "IfcWallStandardCase, column");
  EXPECT_EQ(namesWith("'a, b; (c)'"), "a, b; (c), column");
  EXPECT_EQ(namesWith("\n  'a  b' "), "a  b, column");
  EXPECT_EQ(namesWith("'#39=IFCCOLUMN(''2AvctVUKr0kugbFTf53O9L'',#5,''x'''"),
            "#39=IFCCOLUMN('2AvctVUKr0kugbFTf53O9L',#5,'x', column");
}

}  // namespace
}  // namespace allpairs::test
