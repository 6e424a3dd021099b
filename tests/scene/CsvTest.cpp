// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "Expect.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/EmptyBoxes.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/Scene.h"
#include "support/Boxes.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Named = std::pair<std::string, Box>;

std::vector<Named> readText(const std::string& text) {
  const TempFolder folder;
  const scene::BoxArray array = scene::readCsv(folder.write("boxes.csv", text));
  std::vector<Named> rows;
  for (std::size_t i = 0; i < array.size(); ++i) rows.emplace_back(array.name(i), array.boxes()[i]);
  return rows;
}

void expectCsvProblem(const std::string& text, const std::string& part) {
  const TempFolder folder;
  expectFileError([path = folder.write("bad.csv", text)] { (void)scene::readCsv(path); }, part);
}

const Box kBox{{0.5, 1, 2}, {3, 4, 5e1}};

TEST(Csv, SixNumbersALineAreBoxesNamedByTheirIndex) {
  EXPECT_EQ(readText("0.5,1,2,3,4,5e1\n0.5,1,2,3,4,5e1"), (std::vector<Named>{{"0", kBox}, {"1", kBox}}));
}

TEST(Csv, ANameMayComeFirstOrLast) {
  EXPECT_EQ(readText("left,0.5,1,2,3,4,50\n"), (std::vector<Named>{{"left", kBox}}));
  EXPECT_EQ(readText("0.5,1,2,3,4,50,right\n"), (std::vector<Named>{{"right", kBox}}));
  EXPECT_EQ(readText("a,0.5,1,2,3,4,50\n,0.5,1,2,3,4,50\n"), (std::vector<Named>{{"a", kBox}, {"1", kBox}}))
      << "where the name is missing the index stands in";
}

TEST(Csv, AHeaderMayNameTheColumnsInAnyOrder) {
  EXPECT_EQ(readText("name,minx,miny,minz,maxx,maxy,maxz\na,0.5,1,2,3,4,50\n"), (std::vector<Named>{{"a", kBox}}));
  EXPECT_EQ(readText("Min X,Max X,Min Y,Max Y,Min Z,Max Z\n0.5,3,1,4,2,50\n"), (std::vector<Named>{{"0", kBox}}));
  EXPECT_EQ(readText("x0,y0,z0,x1,y1,z1,what\n0.5,1,2,3,4,50,7\n"), (std::vector<Named>{{"7", kBox}}));
}

/// As np.savetxt() writes a header.
TEST(Csv, ACommentMayNameTheColumns) {
  EXPECT_EQ(readText("# made by hand\n# Min X,Max X,Min Y,Max Y,Min Z,Max Z\n0.5,3,1,4,2,50\n0.5,3,1,4,2,50\n"),
            (std::vector<Named>{{"0", kBox}, {"1", kBox}}));
  EXPECT_EQ(readText("#maxx,maxy,maxz,id,minx,miny,minz\n3,4,50,7,0.5,1,2\n"), (std::vector<Named>{{"7", kBox}}));
  EXPECT_EQ(readText("# xmin,xmax,ymin,ymax,zmin,zmax\nx0,y0,z0,x1,y1,z1\n0.5,1,2,3,4,50\n"),
            (std::vector<Named>{{"0", kBox}}))
      << "a header that is no comment counts";
  for (const char* comment :
       {"# xmin,xmax,ymin,ymax,zmin,zmax,name", "# xmin,xmax,ymin,ymax,zmin", "# xmin,xmax,ymin,ymax,zmin,zmin",
        "# xmin,xmax,ymin,ymax,zmin,zmax,a,b", "# \"xmin,xmax,ymin,ymax,zmin,zmax"})
    EXPECT_EQ(readText(std::string(comment) + "\n0.5,1,2,3,4,50\n"), (std::vector<Named>{{"0", kBox}})) << comment;
}

/// As pandas writes a table whose columns have no names, with a column of the rows' numbers.
TEST(Csv, AHeaderMayNumberTheColumnsBehindTheName) {
  EXPECT_EQ(readText(",0,1,2,3,4,5\na,0.5,1.0,2.0,3.0,4.0,50.0\n"), (std::vector<Named>{{"a", kBox}}));
  EXPECT_EQ(readText(",0,1,2,3,4,6\n"), (std::vector<Named>{{"0", {{0, 1, 2}, {3, 4, 6}}}})) << "a box without a name";
}

/// The warnings of a file that are not of one box: "line: reason" each.
std::string csvWarnings(const std::string& text) {
  const TempFolder folder;
  const auto path = folder.write("boxes.csv", text);
  std::string lines;
  for (const scene::Remark& warning : scene::boxWarnings(scene::readCsv(path), path)) {
    EXPECT_EQ(warning.file, path);
    EXPECT_EQ(warning.subject, "");
    lines += std::to_string(warning.line) + ": " + warning.reason + '\n';
  }
  return lines;
}

TEST(Csv, LinesThatMayNotBeWhatTheyAreTakenForAreNamed) {
  const std::string comment =
      "begins with #, and is passed over as a comment; if it is a box, put its name in quotes\n";
  const std::string box = "a,0,0,0,1,1,1\n";
  EXPECT_EQ(csvWarnings(box + "\n#1,0,0,0,1,1,1\n"), "3: " + comment);
  EXPECT_EQ(csvWarnings("#1,0,0,0,1,1,1\n" + box), "1: " + comment);
  EXPECT_EQ(csvWarnings("name,minx,miny,minz,maxx,maxy,maxz\n#1,0,0,0,1,1,1\n\n#2,0,0,0,1,1,1\n#3,0,0,0,1,1,1\n"),
            "0: holds no boxes\n2: begins with #, and is passed over as a comment, as are 2 other lines; if they are "
            "boxes, put their names in quotes\n");
  EXPECT_EQ(csvWarnings(box + "#1,0,0,0,1,1,1\n#1,0,0,0,1,1,1\n"),
            "2: begins with #, and is passed over as a comment, as is 1 other line; if they are boxes, put their names "
            "in quotes\n");
  EXPECT_EQ(
      csvWarnings(box + "# a,0,0,0,1,1,1\n#a,0,0,0,1,1\n#a,0,0,0,1,1,x\n#\"a\",0,0,0,1,1,1\n\"#1\",0,0,0,1,1,1\n"), "");
  EXPECT_EQ(csvWarnings("0,0,0,1,1,1\n#0,0,0,1,1,1\n"), "") << "without names it can only be a comment";
  EXPECT_EQ(csvWarnings("#1,0,0,0,1,1,1\n0,0,0,1,1,1\n"), "") << "nor can it be a box where names are missing below";
  EXPECT_EQ(csvWarnings("#1,0,0,0,1,1,1\n0,0,0,1,1,1,a\n"), "") << "or stand last";
  EXPECT_EQ(csvWarnings("0,1,2,3,4,5\n0.0,0.0,0.0,1.0,1.0,1.0\n"),
            "1: 0,1,2,3,4,5 is taken for a box; if it numbers the columns, remove it\n");
  for (const char* numbers : {"name,0,1,2,3,4,5\n", "0,1,2,3,4,5,name\n"})
    EXPECT_EQ(csvWarnings(numbers), "1: 0,1,2,3,4,5 is taken for a box; if it numbers the columns, remove it\n");
  EXPECT_EQ(csvWarnings(",0,1,2,3,4,5\n" + box), "");
  EXPECT_EQ(csvWarnings("0,0,0,1,1,1\n0,1,2,3,4,5\n"), "");
  EXPECT_EQ(csvWarnings("0.0,1,2,3,4,5\n"), "");
  EXPECT_EQ(csvWarnings("minx,miny,minz,maxx,maxy,maxz\n0,1,2,3,4,5\n"), "");
}

TEST(Csv, CommentsThatNameTheColumnsInAnotherOrderAndAreNoHeaderAreNamed) {
  const std::string reason =
      ": names columns in another order than boxes are read in, and is passed over as a comment; a header has "
      "commas, and a name for each column\n";
  const std::string boxes = "0,0,0,1,1,1\n0,0,0,1,1,1\n";
  for (const char* comment : {"# xmin xmax ymin ymax zmin zmax", "#xmin;xmax;ymin;ymax;zmin;zmax",
                              "# xmin\txmax\tymin\tymax\tzmin\tzmax", "# columns: xmin,xmax,ymin,ymax,zmin,zmax",
                              R"(# "xmin","xmax","ymin","ymax","zmin","zmax")", "# xmin,xmax,ymin,ymax,zmin,zmax,name"})
    EXPECT_EQ(csvWarnings("\n" + std::string(comment) + '\n' + boxes), "2" + reason) << comment;
  EXPECT_EQ(csvWarnings("# Min X,Max X,Min Y,Max Y,Min Z,Max Z\na,0,0,0,1,1,1\n"), "1" + reason);
  for (const char* comment :
       {"# minx miny minz maxx maxy maxz", "# minx,miny,minz,maxx,maxy,maxz,name", "# xmin xmax ymin ymax zmin",
        "# xmin xmax ymin ymax zmin zmax zmax", "# (xmin, xmax, ymin, ymax, zmin, zmax)",
        "# xmin,xmax,ymin,ymax,zmin,zmax", "# xmin xmax ymin ymax zmin zmax\nminx,miny,minz,maxx,maxy,maxz"})
    EXPECT_EQ(csvWarnings(std::string(comment) + '\n' + boxes), "") << comment;
  EXPECT_EQ(csvWarnings(boxes + "# xmin xmax ymin ymax zmin zmax\n"), "") << "behind the first box";
}

TEST(Csv, CommentsBlankLinesBlanksAndOtherLineEndsArePassedOver) {
  EXPECT_EQ(readText("\xEF\xBB\xBF# made by hand\r\n\r\n  0.5 , 1,\t2, +3, 4, 50 \r\n  \r\n# the end"),
            (std::vector<Named>{{"0", kBox}}));
  EXPECT_EQ(readText("# made by hand\r0.5,1,2,3,4,50\r0.5,1,2,3,4,50"), (std::vector<Named>{{"0", kBox}, {"1", kBox}}));
}

TEST(Csv, AFormFeedIsABlank) { EXPECT_EQ(readText("0.5,1,2,3,4,50\n\f\n\f# between pages\n").size(), 1U); }

TEST(Csv, QuotedNamesMayHoldCommasAndQuotes) {
  EXPECT_EQ(readText(R"("a ""b"", c",0.5,1,2,3,4,50)"), (std::vector<Named>{{R"(a "b", c)", kBox}}));
}

TEST(Csv, InfinitiesAreNumbers) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(readText("-inf,0,0,inf,Infinity,+inf"),
            (std::vector<Named>{{"0", {{-kInfinity, 0, 0}, {kInfinity, kInfinity, kInfinity}}}}));
}

TEST(Csv, AQuotedNameMayHaveLineBreaks) {
  EXPECT_EQ(
      readText("\"a\nb\",0.5,1,2,3,4,50\r\n# \"c, \"d\n \"\"\"\n\n,\"\"\" ,0.5,1,2,3,4,50\ninch\",0.5,1,2,3,4,50"),
      (std::vector<Named>{{"a\nb", kBox}, {"\"\n\n,\"", kBox}, {"inch\"", kBox}}));
  expectCsvProblem("\"a\nb\",1,2,3,4,5,6\n1,2,x,4,5,6,c\n", "bad.csv:3:5: 'x' is not a number");
  expectCsvProblem("a,1,2,3,4,5,6\n\"b,1,2,3,4,5,6\nc,1,2,3,4,5,6\n", "bad.csv:2:1: a quote is not closed");
}

TEST(Csv, AnEmptyFileHoldsNoBoxes) { EXPECT_EQ(readText("# nothing\n"), std::vector<Named>{}); }

TEST(Csv, WhatSeparatesNumbersInPlaceOfCommasIsNamed) {
  const auto problemOf = [](const std::string& text) {
    try {
      (void)readText(text);
    } catch (const FileError& error) {
      return error.problem();
    }
    return std::string();
  };
  const std::string column = "has 1 column where a box has 6, or 7 with a name";
  EXPECT_EQ(problemOf("1;2;3;4;5;6\n"), column + "; commas separate them, not semicolons");
  EXPECT_EQ(problemOf("a\t1\t2\t3\t4\t5\t6\n"), column + "; commas separate them, not tabs");
  EXPECT_EQ(problemOf("1.0e+00 2 3  4 5 6\n"), column + "; commas separate them, not spaces");
  EXPECT_EQ(problemOf("north wall of the old building,0,0,0,1,1,1,7\n"),
            "has 8 columns where a box has 6, or 7 with a name");
  EXPECT_EQ(problemOf("Wall;1;2,0,0,0,1,1,1,1\n"), "has 8 columns where a box has 6, or 7 with a name");
  EXPECT_EQ(problemOf("a b c d e f,0,0,0,1,1\n"), "'a b c d e f' is not a number");
  EXPECT_EQ(problemOf("minx\tminy\tminz\tmaxx\tmaxy\tmaxz\n"), column + "; commas separate them, not tabs");
  EXPECT_EQ(problemOf("0;0;0;1,5;1,5;1\n"),
            "has 3 columns where a box has 6, or 7 with a name; commas separate them, not semicolons");
  EXPECT_EQ(problemOf("1,2,3,4,5,6\n1;2;3;4;5;6\n"),
            "has 1 column where the lines before have 6; commas separate them, not semicolons");
  EXPECT_EQ(problemOf("0,5;1,5;2,5;3,5;4,5;5,5\n"), "'5;1' is not a number; commas separate numbers, not semicolons");
  EXPECT_EQ(problemOf("0,5\t1,5\t2,5\t3,5\t4,5\t5\n"),
            R"('5\x091' is not a number; commas separate numbers, not tabs)");
  EXPECT_EQ(problemOf("a;b,1\n"), "has 2 columns where a box has 6, or 7 with a name");
  EXPECT_EQ(problemOf("part 1 2,1,2,3,4\n"), "has 5 columns where a box has 6, or 7 with a name");
}

TEST(Csv, ASignIsThereOnce) {
  expectCsvProblem("1,2,3,4,5,+-6\n", "bad.csv:1:11: '+-6' is not a number");
  expectCsvProblem("1,2,3,4,5,++6\n", "bad.csv:1:11: '++6' is not a number");
}

TEST(Csv, ErrorsNameLineAndColumn) {
  expectCsvProblem("1,2,3,4,5,6\n\n1,2,x,4,5,6\n", "bad.csv:3:5: 'x' is not a number");
  expectCsvProblem("1,2,3,4,5,6\n1,2,,4,5,6\n", "bad.csv:2:5: a number is missing");
  expectCsvProblem("1,2,3,4,5,nan\n", "bad.csv:1:11: is not a number (NaN)");
  expectCsvProblem("1,2,3,4,5,1e999\n", "bad.csv:1:11: 1e999 is too large");
  expectCsvProblem("1,2,3,4,5\n", "bad.csv:1: has 5 columns");
  expectCsvProblem("1,2,3,4,5,6\n1,2,3,4,5,6,7\n", "bad.csv:2: has 7 columns");
  expectCsvProblem("\"a,1,2,3,4,5,6\n", "bad.csv:1:1: a quote is not closed");
  expectCsvProblem("\"a\"b,1,2,3,4,5,6\n", "bad.csv:1:4: text after a closing quote");
  expectCsvProblem("minx,miny,minz,maxx,maxy\n", "bad.csv:1: the header has no column 'maxz'");
  expectCsvProblem("minx,miny,minz,maxx,maxy,maxz,a,b\n", "bad.csv:1:33: column 'b' is not known");
  expectCsvProblem("x,y,z,dx,dy,dz\n0,0,0,1,1,1\n", "column 'y' is not known: a box has minx,miny,minz,maxx,maxy,maxz");
  expectCsvProblem("id,name,minx,miny,minz,maxx,maxy,maxz\n",
                   "bad.csv:1:4: column 'name' is not known: a box has minx,miny,minz,maxx,maxy,maxz and a name, for "
                   "which 'id' is taken");
  expectCsvProblem(std::string("1,2,3,4,5,6\n1\0,\0", 16), "bad.csv:2: is no text");
  expectCsvProblem("# 8 boxes\n1,2,3,4,5,6,7\n",
                   "bad.csv:2: has seven numbers, of which the first or the last is a name");
  expectCsvProblem("minx,minx,minz,maxx,maxy,maxz\n", "bad.csv:1:6: column 'minx' is there twice");
}

TEST(Csv, AFileCutAnywhereIsReadOrAnErrorButNeverMore) {
  const TempFolder folder;
  const std::string text = "name,minx,miny,minz,maxx,maxy,maxz\n\"a,b\",0,0,0,1,1,1\nc,0,0,0,2,2,2\n";
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto path = folder.write("cut.csv", std::string_view(text).substr(0, length));
    try {
      EXPECT_LE(scene::readCsv(path).size(), 2U);
    } catch (const FileError&) {
      // as good: the cut was noticed
    }
  }
}

}  // namespace
}  // namespace allpairs::test
