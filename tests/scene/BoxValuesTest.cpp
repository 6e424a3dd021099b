// SPDX-License-Identifier: MIT
#include "allpairs/scene/BoxValues.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "Expect.h"
#include "allpairs/Error.h"
#include "support/Npy.h"
#include "support/Numbers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using scene::BoxValue;
using scene::BoxValues;
using Paths = std::vector<std::filesystem::path>;

class BoxValuesOf : public ::testing::Test {
 protected:
  template <class T>
  std::filesystem::path file(const char* name, const std::vector<T>& numbers, const char* descr) {
    return folder.write(name, npyNumbers(numbers, descr));
  }

  template <class Value>
  static std::vector<Value> read(const Paths& paths, BoxValue kind, std::uint64_t boxes) {
    std::vector<Value> values(boxes);
    BoxValues(paths, kind, boxes).read(0, values);
    return values;
  }

  void expectProblem(const std::string& bytes, BoxValue kind, const std::string& part) {
    const std::filesystem::path path = folder.write("bad.npy", bytes);
    expectFileError(
        [&] {
          if (kind == BoxValue::Margin) {
            (void)read<double>({path}, kind, 3);
          } else {
            (void)read<std::uint32_t>({path}, kind, 3);
          }
        },
        "bad.npy: " + part);
  }

  TempFolder folder;
};

TEST_F(BoxValuesOf, MarginsAreFloat32OrFloat64InEitherByteOrder) {
  const std::vector<double> expected{0.25, -1.5, kInfinity};
  for (const char* descr : {"<f8", ">f8"}) {
    EXPECT_EQ(read<double>({file("m.npy", expected, descr)}, BoxValue::Margin, 3), expected) << descr;
  }
  const std::vector<float> narrow{0.25F, -1.5F, static_cast<float>(kInfinity)};
  for (const char* descr : {"<f4", ">f4"}) {
    EXPECT_EQ(read<double>({file("m.npy", narrow, descr)}, BoxValue::Margin, 3), expected) << descr;
  }
}

TEST_F(BoxValuesOf, LabelsAreIntegersOfAnyWidth) {
  const std::vector<std::uint32_t> expected{0, 7, 120};
  const auto same = [&](auto number, const char* descr) {
    const std::vector<decltype(number)> numbers{0, 7, 120};
    EXPECT_EQ(read<std::uint32_t>({file("g.npy", numbers, descr)}, BoxValue::Group, 3), expected) << descr;
  };
  same(std::uint8_t{}, "|u1");
  same(std::int8_t{}, "|i1");
  same(std::uint16_t{}, "<u2");
  same(std::int16_t{}, ">i2");
  same(std::uint32_t{}, "<u4");
  same(std::uint32_t{}, ">u4");
  same(std::int32_t{}, "<i4");
  same(std::uint64_t{}, ">u8");
  same(std::int64_t{}, "<i8");
  const std::vector<std::uint32_t> greatest{0xffffffff, 0, 0xffffffff};
  EXPECT_EQ(read<std::uint32_t>({file("k.npy", greatest, "<u4")}, BoxValue::Mask, 3), greatest);
}

TEST_F(BoxValuesOf, MarginsMayBeIntegersOfAnyWidth) {
  const std::vector<double> expected{0, 7, -120};
  const auto same = [&](auto number, const char* descr) {
    const std::vector<decltype(number)> numbers{0, 7, -120};
    EXPECT_EQ(read<double>({file("m.npy", numbers, descr)}, BoxValue::Margin, 3), expected) << descr;
  };
  same(std::int8_t{}, "|i1");
  same(std::int16_t{}, ">i2");
  same(std::int32_t{}, "<i4");
  same(std::int64_t{}, "<i8");
  const std::vector<double> greatest{0, 9007199254740992.0, 1};
  const std::vector<std::uint64_t> numbers{0, std::uint64_t{1} << 53, 1};
  EXPECT_EQ(read<double>({file("m.npy", numbers, ">u8")}, BoxValue::Margin, 3), greatest);
}

TEST_F(BoxValuesOf, BoolsAreZeroAndOne) {
  const std::vector<std::uint8_t> bytes{0, 1, 1};
  const std::vector<std::uint32_t> labels{0, 1, 1};
  for (const BoxValue kind : {BoxValue::Group, BoxValue::Category, BoxValue::Mask}) {
    EXPECT_EQ(read<std::uint32_t>({file("b.npy", bytes, "|b1")}, kind, 3), labels);
  }
  EXPECT_EQ(read<double>({file("b.npy", bytes, "|b1")}, BoxValue::Margin, 3), (std::vector<double>{0, 1, 1}));
}

TEST_F(BoxValuesOf, MarginsMayBeFloat16) {
  const std::vector<std::uint16_t> bits{0x0000, 0x0001, 0x83ff, 0x0400, 0x3c00, 0xc100, 0x7bff, 0x7c00};
  const std::vector<double> expected{0, 0x1p-24, -1023 * 0x1p-24, 0x1p-14, 1, -2.5, 65504, kInfinity};
  for (const char* descr : {"<f2", ">f2"}) {
    EXPECT_EQ(read<double>({file("m.npy", bits, descr)}, BoxValue::Margin, 8), expected) << descr;
  }
}

TEST_F(BoxValuesOf, SeveralFilesAreOneWhereverReadingBegins) {
  const std::vector<double> all{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const Paths paths{file("a.npy", std::vector<double>{0, 1, 2}, "<f8"), file("b.npy", std::vector<float>{}, "<f4"),
                    file("c.npy", std::vector<float>{3, 4, 5, 6}, ">f4"),
                    file("d.npy", std::vector<double>{7, 8, 9}, ">f8")};
  BoxValues values(paths, BoxValue::Margin, 10);
  for (std::size_t begin = 0; begin <= 10; ++begin) {
    for (std::size_t end = begin; end <= 10; ++end) {
      std::vector<double> part(end - begin);
      values.read(begin, part);
      EXPECT_EQ(part, std::vector<double>(all.data() + begin, all.data() + end));
    }
  }
  std::vector<double> beyond(2);
  EXPECT_THROW(values.read(9, beyond), InvalidArgument);
  EXPECT_THROW(values.read(11, Span<double>()), InvalidArgument);
  std::vector<std::uint32_t> labels(2);
  EXPECT_THROW(values.read(0, labels), InvalidArgument);
}

TEST_F(BoxValuesOf, NoBoxesNeedNoNumbers) {
  EXPECT_TRUE(read<double>({file("none.npy", std::vector<double>{}, "<f8")}, BoxValue::Margin, 0).empty());
  EXPECT_TRUE(read<std::uint32_t>({}, BoxValue::Mask, 0).empty());
}

TEST_F(BoxValuesOf, WhatIsWrongIsNamed) {
  expectProblem(npyNumbers<double>({0, kNan, 0}, "<f8"), BoxValue::Margin, "margin 1 is a NaN");
  expectProblem(npyNumbers<float>({0, 0, -static_cast<float>(kInfinity)}, "<f4"), BoxValue::Margin,
                "margin 2 is -infinity");
  expectProblem(npyNumbers<std::int64_t>({0, 0, -1}, "<i8"), BoxValue::Group,
                "number 2 is -1; 0 to 4294967295 are taken");
  expectProblem(npyNumbers<std::uint64_t>({4294967296, 0, 0}, "<u8"), BoxValue::Mask, "number 0 is 4294967296; ");
  expectProblem(npyNumbers<double>({1, 2, 3}, "<c8"), BoxValue::Margin,
                "holds numbers of type '<c8'; margins are floats or integers");
  expectProblem(npyNumbers<std::int64_t>({1, 2, (std::int64_t{1} << 53) + 1}, "<i8"), BoxValue::Margin,
                "margin 2 is 9007199254740993; float64 holds integers up to 2^53");
  expectProblem(npyNumbers<std::int64_t>({-(std::int64_t{1} << 53) - 1, 2, 3}, "<i8"), BoxValue::Margin,
                "margin 0 is -9007199254740993; ");
  expectProblem(npyNumbers<std::uint16_t>({0, 0x7e00, 0}, "<f2"), BoxValue::Margin, "margin 1 is a NaN");
  expectProblem(npyNumbers<std::uint16_t>({0, 0, 0xfc00}, "<f2"), BoxValue::Margin, "margin 2 is -infinity");
  expectProblem(npyNumbers<std::uint16_t>({0, 0, 0}, "<f2"), BoxValue::Mask,
                "holds numbers of type '<f2'; masks are integers");
  expectProblem(npyNumbers<double>({1, 2, 3}, "<f8"), BoxValue::Category,
                "holds numbers of type '<f8'; categories are integers");
  expectProblem(npyBytes({{}, {}, {}}), BoxValue::Margin, "has shape (3, 6); margins are (n,)");
  expectProblem(npyNumbers<double>({1, 2}, "<f8"), BoxValue::Margin, "has 2 margins for 3 boxes");
  expectProblem(npyNumbers<std::uint8_t>({1}, "|u1"), BoxValue::Category, "has 1 category for 3 boxes");
  const std::string whole = npyNumbers<double>({1, 2, 3}, "<f8");
  expectProblem(whole.substr(0, whole.size() - 1), BoxValue::Margin,
                "holds 23 bytes of numbers where its shape (3,) needs 24");
  expectProblem(whole.substr(0, 20), BoxValue::Margin, "ends within its header");
  const std::filesystem::path good = folder.write("good.npy", whole);
  expectFileError(
      [&] {
        (void)read<double>({good, good}, BoxValue::Margin, 5);
      },
      "good.npy: makes, with the files before it, 6 margins for 5 boxes");
  expectFileError([&] { (void)read<double>({folder.path() / "gone.npy"}, BoxValue::Margin, 5); }, "gone.npy: no such");
  expectFileError(
      [&] {
        BoxValues values(Paths{good}, BoxValue::Margin, 3);
        folder.write("good.npy", npyNumbers<double>({1, 2}, "<f8"));
        std::vector<double> numbers(3);
        values.read(0, numbers);
      },
      "good.npy: changed while it was read");
}

TEST_F(BoxValuesOf, AHeaderOfNoTypeIsAnError) {
  expectProblem(npyHeaderBytes("{'descr': '', 'fortran_order': False, 'shape': (3,), }"), BoxValue::Group,
                "holds numbers of type ''");
}

}  // namespace
}  // namespace allpairs::test
