// SPDX-License-Identifier: MIT
#include "allpairs/scene/WriteResult.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/Numbers.h"

namespace allpairs::test {
namespace {

/// Three models with all that is awkward to write, and some pairs of them.
struct Example {
  std::vector<scene::ModelRecord> models{
      {.name = "plain", .type = "BoxModel", .elements = 1, .box = {{0.1, -0.0, 5e-324}, {1e308, 1.0 / 3, kInfinity}}},
      {.name = "a \"quoted\", name\n", .type = "TSphereModel", .elements = 7, .simulated = false, .groups = {-1, 3}},
      {.name = "\xff\x01 \xc3\xa9", .type = "TLineModel", .selfCollision = true, .contactDistance = 0.2}};
  std::vector<Pair> pairs{{1, 0}, {2, 0}, {2, 2}};

  [[nodiscard]] scene::ResultView view() const {
    return {.modelCount = models.size(), .model = [this](std::size_t i) { return models[i]; }, .pairs = pairs};
  }
};

template <class Writer>
std::string written(Writer write, const scene::ResultView& result) {
  std::string text;
  const auto sink = [&text](std::string_view bytes) { text += bytes; };
  write(result, sink);
  return text;
}

TEST(WriteJson, IsValidAndReadsBackTheSame) {
  const Example example;
  const auto json = nlohmann::json::parse(written(scene::writeJson, example.view()));
  ASSERT_EQ(json["models"].size(), 3U);
  EXPECT_EQ(json["models"][0]["box"][0][0].get<double>(), 0.1);
  EXPECT_EQ(json["models"][0]["box"][0][2].get<double>(), 5e-324);
  EXPECT_EQ(json["models"][0]["box"][1][0].get<double>(), 1e308);
  EXPECT_EQ(json["models"][0]["box"][1][1].get<double>(), 1.0 / 3);
  EXPECT_EQ(json["models"][0]["box"][1][2], "inf");
  EXPECT_EQ(json["models"][1]["name"], "a \"quoted\", name\n");
  EXPECT_EQ(json["models"][1]["simulated"], false);
  EXPECT_EQ(json["models"][1]["groups"], (nlohmann::json{-1, 3}));
  EXPECT_EQ(json["models"][1]["box"], (nlohmann::json{{"inf", "inf", "inf"}, {"-inf", "-inf", "-inf"}}));
  EXPECT_EQ(json["models"][2]["name"], "\xef\xbf\xbd\x01 \xc3\xa9") << "a byte that is no UTF-8 is replaced";
  EXPECT_EQ(json["models"][2]["selfCollision"], true);
  EXPECT_EQ(json["models"][2]["contactDistance"], 0.2);
  EXPECT_EQ(json["pairs"], (nlohmann::json{{1, 0}, {2, 0}, {2, 2}}));
  EXPECT_EQ(json["statistics"]["pairs"], 3);
}

TEST(WriteJson, SaysWhatWasIgnored) {
  const std::vector<scene::Remark> remarks{{.file = "a.scn", .line = 3, .subject = "/s", .reason = "\"why\""}};
  const auto json = nlohmann::json::parse(written(scene::writeJson, scene::ResultView{.ignored = remarks}));
  EXPECT_EQ(json["ignored"],
            nlohmann::json::parse(R"([{"file": "a.scn", "line": 3, "subject": "/s", "reason": "\"why\""}])"));
}

TEST(WriteJson, OfNothingIsValid) {
  const auto json = nlohmann::json::parse(written(scene::writeJson, scene::ResultView{}));
  EXPECT_TRUE(json["models"].empty());
  EXPECT_TRUE(json["pairs"].empty());
  EXPECT_EQ(json["ignored"], nlohmann::json::array());
}

TEST(WriteJson, SwappedPairsAreWrittenSecondFirst) {
  const Example example;
  scene::ResultView view = example.view();
  view.swapped = true;
  EXPECT_EQ(nlohmann::json::parse(written(scene::writeJson, view))["pairs"], (nlohmann::json{{0, 1}, {0, 2}, {2, 2}}));
}

TEST(WriteCsv, QuotesNamesThatNeedIt) {
  const Example example;
  EXPECT_EQ(written(scene::writeCsv, example.view()),
            "first,second\n\"a \"\"quoted\"\", name\n\",plain\n\xff\x01 \xc3\xa9,plain\n"
            "\xff\x01 \xc3\xa9,\xff\x01 \xc3\xa9\n");
}

TEST(WriteNpy, IsAnArrayOfUint32WithAHeaderOf128Bytes) {
  const Example example;
  const std::string bytes = written(scene::writeNpy, example.view());
  EXPECT_EQ(bytes.substr(0, 128), npyHeaderBytes("{'descr': '<u4', 'fortran_order': False, 'shape': (3, 2), }"));
  EXPECT_EQ(pairsOfNpy(bytes), example.pairs);
}

TEST(WriteNpy, HeadersOfOtherArraysAreThoseOfNumPy) {
  const auto header = [](std::vector<std::uint64_t> shape) { return scene::npyHeader("<f8", shape); };
  EXPECT_EQ(header({5}), npyHeaderBytes("{'descr': '<f8', 'fortran_order': False, 'shape': (5,), }"));
  EXPECT_EQ(header({200, 3, 6}), npyHeaderBytes("{'descr': '<f8', 'fortran_order': False, 'shape': (200, 3, 6), }"));
  EXPECT_EQ(header({UINT64_MAX, UINT64_MAX, UINT64_MAX}).size() % 64, 0);
}

TEST(Write, ManyPairsComeThroughWholeAndInPieces) {
  Example example;
  example.pairs.clear();
  for (std::uint32_t i = 0; i < 100'000; ++i) example.pairs.push_back({i % 3, (i / 3) % 3});
  std::size_t pieces = 0;
  std::string text;
  const auto sink = [&](std::string_view bytes) {
    ++pieces;
    text += bytes;
  };
  scene::writeJson(example.view(), sink);
  EXPECT_GT(pieces, 5U);
  const auto json = nlohmann::json::parse(text);
  ASSERT_EQ(json["pairs"].size(), example.pairs.size());
  EXPECT_EQ(json["pairs"][99'999], (nlohmann::json{0, 0}));
  EXPECT_EQ(pairsOfNpy(written(scene::writeNpy, example.view())), example.pairs);
}

}  // namespace
}  // namespace allpairs::test
