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
      {R"(\X2\008007FF0800\X0\)", "\u0080\u07ff\u0800"},  // where one more byte is needed
      {R"(\X4\0000FFFD00010000\X0\)", "\ufffd\U00010000"},
      {R"(\X2\D800DC00DBFFDFFF\X0\)", "\U00010000\U0010FFFF"},  // the least and the greatest of two codes
      {R"(\X2\D7FFE000\X0\)", "\ud7ff\ue000"},                  // and beside them
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

/// The names where a piece of the file is another, and the wall is called 'a  b': Assimp's own names keep one blank.
std::string namesWhere(const std::string& piece, const std::string& other) {
  std::string text = kIfc;
  text.replace(text.find(piece), piece.size(), other);
  text.replace(text.find("'wall'"), 6, "'a  b'");
  const TempFolder folder;
  const scene::Scene scene = scene::readInput(folder.write("a.ifc", text));
  return scene.models.at(0)->getName() + ", " + scene.models.at(1)->getName();
}

TEST(IfcNames, AreFoundBehindCommentsAndStringsThatLookLikeOne) {
  EXPECT_EQ(namesWhere("'1','a','a');", "'1','a /* b; ','a');"), "a  b, column");
  for (const std::string comment : {"/* a */\n", "/* it's; */\n", "/**/\n", "/*/ a */\n", "/* a */ /* b */\n"}) {
    EXPECT_EQ(namesWhere("#27=", comment + "#27="), "a  b, column") << comment;
  }
}

}  // namespace
}  // namespace allpairs::test
