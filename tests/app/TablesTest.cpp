// SPDX-License-Identifier: MIT
// Tables for people, and the texts that they are made of, whole: programs that are run take another time each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/Output.h"
#include "cli/Suggestion.h"
#include "cli/Table.h"
#include "cli/Text.h"
#include "support/TempFolder.h"
#include "track/TrackReport.h"

namespace allpairs::test {
namespace {

std::string tableText(const scene::ResultView& result, const app::TableNotes& notes) {
  std::string text;
  writeTable(result, notes, [&text](std::string_view part) { text += part; });
  return text;
}

scene::ResultView resultOf(const std::vector<std::string>& names, const std::vector<Pair>& pairs) {
  scene::ResultView result;
  result.modelCount = names.size();
  result.model = [&names](std::size_t i) { return scene::ModelRecord{.name = names[i], .type = ""}; };
  result.pairs = pairs;
  return result;
}

TEST(Tables, OfAResultSayAllThatIsKnown) {
  const std::vector<std::string> names{"a", "a longer one", "c\n"};
  const std::vector<Pair> pairs{{1, 0}, {2, 1}};
  scene::ResultView result = resultOf(names, pairs);
  result.statistics = {"auto", 2, 0.0, 1234567, 1234, 12, 0.0005, 0.25, true};
  app::TableNotes notes{.method = "boxes", .simulated = 1, .remarkCount = 1, .isPartial = true};
  EXPECT_EQ(tableText(result, notes),
            "models   3, of which 1 is simulated\n"
            "method   boxes\n"
            "ignored  1 part of the input; 'allpairs info --partial' lists them\n"
            "pairs    2\n\n"
            "  a longer one   a\n"
            "  c\\x0a          a longer one\n\n"
            "tests    1,234 of boxes, 12 of flags and groups; the double loop makes 1,234,567\n"
            "verify   the exhaustive strategy gives the same pairs in the same order\n"
            "time     500.0 us to read, 250.0 ms to detect on 2 threads\n");
  result.swapped = true;
  result.statistics = {"auto", 1, 0.0, 3, 2, 0, 0.001, 1.0, false};
  notes = {.method = "shapes", .simulated = 2, .remarkCount = 2};
  EXPECT_EQ(tableText(result, notes),
            "models   3, of which 2 are simulated\n"
            "method   shapes\n"
            "ignored  2 parts of the input; 'allpairs info' lists them\n"
            "pairs    2\n\n"
            "  a              a longer one\n"
            "  a longer one   c\\x0a\n\n"
            "tests    2 of boxes; the double loop makes 3\n"
            "time     1.0 ms to read, 1.00 s to detect on 1 thread\n");
  EXPECT_EQ(app::tableFoot(result, 0.125),
            "tests    2 of boxes; the double loop makes 3\n"
            "time     1.0 ms to read, 1.00 s to detect on 1 thread, 125.0 ms to look at "
            "shapes\n");
  result.pairs = {};
  EXPECT_EQ(tableText(result, {.method = "boxes", .simulated = 3}),
            "models   3\nmethod   boxes\npairs    0\n\n"
            "tests    2 of boxes; the double loop makes 3\n"
            "time     1.0 ms to read, 1.00 s to detect on 1 thread\n");
}

TEST(Tables, ShowFiftyPairsAndAsMuchOfANameAsFits) {
  const std::vector<std::string> names{"0123456789012345678901234567890123456789", std::string(60, 'x'), "b"};
  std::vector<Pair> pairs(50, {2, 2});
  const auto linesOf = [&](std::size_t width) {
    app::TableNotes notes{.method = "m", .simulated = 3};
    if (width != 0) notes.width = width;
    const std::string text = tableText(resultOf(names, pairs), notes);
    return text.substr(0, text.find("\n\ntests")).substr(text.find("\n\n") + 2);
  };
  std::string fifty;
  for (int i = 0; i < 50; ++i) fifty += "  b   b\n";
  EXPECT_EQ(linesOf(0) + '\n', fifty);
  pairs.push_back({2, 2});
  EXPECT_EQ(linesOf(0), fifty + "  ... and 1 more; --format csv or json gives all");
  pairs = {{0, 2}, {1, 0}, {2, 1}};
  EXPECT_EQ(linesOf(0), "  " + names[0] + std::string(8, ' ') + "   b\n  " + names[1] + "   " + names[0] + "\n  b" +
                            std::string(47, ' ') + "   " + names[1]);
  EXPECT_EQ(linesOf(36),
            "  0123456…3456789"
            "   b\n  xxxxxxx…xxxxxxx   0123456…3456789\n  b                 xxxxxxx…xxxxxxx");
}

std::string trackText(const app::TrackReport& report, const std::string& format) {
  const TempFolder folder;
  app::Output output(folder.path() / "out");
  writeTrack(report, format, output);
  output.commit();
  return readBytes(folder.path() / "out");
}

TEST(Tables, OfFramesCountWhatIsInThem) {
  app::TrackReport report;
  report.boxes = 1200;
  report.distance = 0.25;
  report.frames = {{5, 5, 0, 9.0}, {3, 0, 2, 1.0}, {7, 4, 0, 3.0}, {7, 0, 0, 2.0}};
  report.threads = 2;
  report.rebuilds = 1;
  report.verified = true;
  EXPECT_EQ(trackText(report, "table"),
            "frames   4 of 1,200 boxes\ndistance 0.25\npairs    3 to 7 a frame\nbegan    9\nended    2\n"
            "verify   searching each frame from scratch gives the same pairs and changes\n"
            "time     2.0000 ms median, 3.0000 ms 99th percentile, 3.0000 ms worst (frame 2)\n"
            "first    9.0000 ms; 1 rebuild of the order since, on 2 threads\n");
  EXPECT_EQ(trackText(report, "csv"),
            "frame,pairs,began,ended,milliseconds\n0,5,5,0,9\n1,3,0,2,1\n2,7,4,0,3\n3,7,0,0,2\n");
  EXPECT_EQ(trackText(report, "json"),
            R"({"frames":4,"boxes":1200,"pairs":[5,3,7,7],"began":[5,0,4,0],"ended":[0,2,0,0],)"
            R"("milliseconds":[9.0,1.0,3.0,2.0],"statistics":{"distance":0.25,"began":9,"ended":2,"medianMs":2.0,)"
            R"("percentile99Ms":3.0,"worstMs":3.0,"worstFrame":2,"rebuilds":1,"threads":2,"verified":true}})"
            "\n");
  const std::string npy = trackText(report, "npy");
  std::vector<double> numbers(16);
  ASSERT_GT(npy.size(), sizeof(double) * numbers.size());
  std::memcpy(numbers.data(), npy.data() + npy.size() - sizeof(double) * numbers.size(),
              sizeof(double) * numbers.size());
  EXPECT_EQ(numbers, (std::vector<double>{5, 5, 0, 9, 3, 0, 2, 1, 7, 4, 0, 3, 7, 0, 0, 2}));
}

TEST(FrameTimes, AreThoseOfAllFramesButTheFirst) {
  std::mt19937 random(1);
  for (std::size_t count = 1; count <= 202; ++count) {
    std::vector<app::TrackedFrame> frames(count);
    for (std::size_t i = 0; i < count; ++i) frames[i].milliseconds = static_cast<double>(random() % 4096);
    frames[0].milliseconds = 5000.0;
    const auto begin = frames.begin() + (count > 1 ? 1 : 0);
    const auto rated = static_cast<std::size_t>(frames.end() - begin);
    const auto countUpTo = [&](double limit) {
      return static_cast<std::size_t>(
          std::count_if(begin, frames.end(), [&](const auto& frame) { return frame.milliseconds <= limit; }));
    };
    const auto leastOf = [&](std::size_t hundredths) {  // that so many of 100 frames don't exceed
      double least = 5000.0;
      for (auto frame = begin; frame != frames.end(); ++frame) {
        const bool isEnough = 100 * countUpTo(frame->milliseconds) >= hundredths * rated;
        if (isEnough) least = std::min(least, frame->milliseconds);
      }
      return least;
    };
    const auto worst = std::max_element(begin, frames.end(),
                                        [](const auto& a, const auto& b) { return a.milliseconds < b.milliseconds; });
    const app::FrameTimes times = app::timesOf(frames);
    EXPECT_EQ(times.medianMs, leastOf(50)) << count;
    EXPECT_EQ(times.percentile99Ms, leastOf(99)) << count;
    EXPECT_EQ(times.worstMs, worst->milliseconds) << count;
    EXPECT_EQ(times.worstFrame, static_cast<std::size_t>(worst - frames.begin())) << count;
  }
}

TEST(Texts, OfNumbersAreReadByPeople) {
  EXPECT_EQ(app::grouped(999), "999");
  EXPECT_EQ(app::grouped(1000), "1,000");
  EXPECT_EQ(app::grouped(18446744073709551615U), "18,446,744,073,709,551,615");
  EXPECT_EQ(app::counted(0, "box", "boxes"), "0 boxes");
  EXPECT_EQ(app::counted(1, "box", "boxes"), "1 box");
  EXPECT_EQ(app::counted(2, "model"), "2 models");
  EXPECT_EQ(app::countedBoxes(1000, 1), "1,000 and 1 box");
  EXPECT_EQ(app::boxText({{0.1234567, 9999.5, 10000.25}, {1.0, 123456.75, 1e12}}),
            "[0.123457, 9999.5, 10000.25] to [1, 123456.75, 1e+12]");
  EXPECT_EQ(app::boxText({{-999999999999.0, -123456.75, 0}, {0, 0, 0}}), "[-999999999999, -123456.75, 0] to [0, 0, 0]");
  EXPECT_EQ(app::boxText({{0, 0, 1}, {1, 1, 0}}), "empty");
}

TEST(Texts, OfFilesAndShellsKeepTheirLetters) {
  EXPECT_EQ(app::lowerExtension("A/B.NPy"), ".npy");
  EXPECT_EQ(app::lowerExtension("a.AZ[@`{z"), ".az[@`{z");
  EXPECT_EQ(app::shellWord("a-b_c./,:=@%+Z9ä"), "a-b_c./,:=@%+Z9ä");
  EXPECT_EQ(app::shellWord(""), "''");
  EXPECT_EQ(app::shellWord("it's"), "'it'\\''s'");
}

TEST(Texts, OfThreadsHaveFourDigitsAtMost) {
  EXPECT_EQ(app::parseThreads("0"), 0U);
  EXPECT_EQ(app::parseThreads("9999"), 9999U);
  for (const char* text : {"10000", "00001", "", "-1", "1.0", "1 "}) {
    EXPECT_THROW(static_cast<void>(app::parseThreads(text)), app::UsageError) << text;
  }
}

TEST(Suggestions, AreForWordsOfWhichAThirdMayBeWrong) {
  const std::vector<std::string> choices{"detect", "generate", "info"};
  EXPECT_EQ(app::suggestionFor("detcet", choices), " - did you mean detect?");
  EXPECT_EQ(app::suggestionFor("xxtect", choices), " - did you mean detect?");
  EXPECT_EQ(app::suggestionFor("xxxect", choices), "");
  EXPECT_EQ(app::suggestionFor("gener", choices), " - did you mean generate?") << "a word may be cut";
  EXPECT_EQ(app::suggestionFor("gene", choices), "");
  EXPECT_EQ(app::suggestionFor("inf", choices), " - did you mean info?");
  EXPECT_EQ(app::suggestionFor("i", {"a"}), "") << "nothing of it is left";
  EXPECT_EQ(app::suggestionFor(std::string(40, 'a'), {std::string(41, 'a')}),
            " - did you mean " + std::string(41, 'a') + '?');
  EXPECT_EQ(app::suggestionFor(std::string(41, 'a'), {std::string(42, 'a')}), "");
}

}  // namespace
}  // namespace allpairs::test
