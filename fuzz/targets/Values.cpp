// SPDX-License-Identifier: MIT
// Files that are read a part at a time, of boxes and of what boxes have beside their bounds: what is read is what the
// bytes say, also after an error and while the file is cut, and a join of it gives the bytes of the double loop.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "../Choices.h"
#include "../SceneFile.h"
#include "../Sides.h"
#include "allpairs/scene/BoxRows.h"
#include "allpairs/scene/BoxValues.h"
#include "allpairs/scene/FileError.h"
#include "join/JoinCase.h"

namespace allpairs::fuzz {
namespace {

namespace fs = std::filesystem;
using scene::BoxValue;
using Paths = std::vector<fs::path>;

constexpr std::size_t kMostJoined = 150;  // boxes: the double loop is quadratic

/// A number of a file in each form in which it may be read.
struct Number {
  double real = 0.0;
  std::uint32_t label = 0;
  bool isTaken = false;  ///< As what the file is read as.
};

/// What the bytes of a .npy file say, read without the library, of a file that the library takes.
class Stored {
 public:
  explicit Stored(std::string_view file, BoxValue kind = BoxValue::Margin) : m_kind(kind) {
    constexpr std::size_t kStart = 12;
    if (file.size() < kStart) return;
    const auto byte = [file](std::size_t i) { return std::size_t{static_cast<unsigned char>(file[i])}; };
    const bool isFirst = byte(6) == 1;
    const std::size_t begin = isFirst ? 10 : kStart;
    const std::size_t length = byte(8) + 256 * byte(9) + (isFirst ? 0 : 65536 * (byte(10) + 256 * byte(11)));
    if (file.size() - begin < length) return;
    readHeader(file.substr(begin, length));
    m_data = file.substr(begin + length);
  }

  [[nodiscard]] std::size_t size() const { return m_width == 0 ? 0 : m_data.size() / m_width; }
  [[nodiscard]] bool isFloat() const { return m_letter == 'f'; }
  [[nodiscard]] bool isFloat64() const { return m_width == 8; }

  [[nodiscard]] Number operator[](std::size_t i) const {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < m_width; ++k) {
      const std::size_t place = i * m_width + (m_isBig ? k : m_width - 1 - k);
      bits = bits << 8 | static_cast<unsigned char>(m_data[place]);
    }
    if (isFloat()) return realOf(bits);
    if (m_letter == 'b') return {bits != 0 ? 1.0 : 0.0, bits != 0 ? 1U : 0U, true};
    const bool isNegative = m_letter == 'i' && (bits >> (8 * m_width - 1)) != 0;
    const std::uint64_t above = m_width == 8 ? 0 : std::uint64_t{1} << (8 * m_width);
    const std::uint64_t magnitude = isNegative ? above - bits : bits;
    const double real = isNegative ? -static_cast<double>(magnitude) : static_cast<double>(magnitude);
    const bool isMargin = m_kind == BoxValue::Margin;
    const std::uint64_t most = isMargin ? std::uint64_t{1} << 53U : std::numeric_limits<std::uint32_t>::max();
    return {real, static_cast<std::uint32_t>(bits), magnitude <= most && (isMargin || !isNegative)};
  }

  /// Bound k of box i: of two sets of three, in rows or in columns.
  [[nodiscard]] double bound(std::size_t i, std::size_t k) const {
    return (*this)[m_isFortran ? k * (size() / 6) + i : 6 * i + k].real;
  }

 private:
  void readHeader(std::string_view header) {
    const std::size_t key = std::min(header.find("descr"), header.size());
    const std::size_t colon = std::min(header.find(':', key), header.size());
    const std::size_t begin = std::min(header.find_first_of("'\"", colon), header.size());
    std::string_view type = header.substr(begin).substr(std::min<std::size_t>(1, header.size() - begin));
    m_isBig = type.starts_with('>');
    type.remove_prefix(std::min(type.find_first_not_of("<>|="), type.size()));
    if (type.size() < 2) return;
    m_letter = type[0];
    m_width = static_cast<std::size_t>(type[1] - '0');
    m_isFortran = header.find("True") != std::string_view::npos;
  }

  /// A float16, whose bits are those of a float32 with fewer of both parts; a subnormal one is a multiple of 2^-24.
  static double halfOf(unsigned bits) {
    const unsigned rest = bits & 0x7fffU;
    const unsigned exponent = rest >= 0x7c00U ? 0x7f800000U | rest << 13U : (rest << 13U) + 0x38000000U;
    const double size =
        rest < 0x400U ? static_cast<double>(rest) * 0x1p-24 : static_cast<double>(std::bit_cast<float>(exponent));
    return (bits & 0x8000U) != 0 ? -size : size;
  }

  [[nodiscard]] Number realOf(std::uint64_t bits) const {
    const double real = m_width == 8   ? std::bit_cast<double>(bits)
                        : m_width == 2 ? halfOf(static_cast<unsigned>(bits))
                                       : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    return {real, 0, !std::isnan(real) && real != -std::numeric_limits<double>::infinity()};
  }

  BoxValue m_kind;
  std::string_view m_data;
  char m_letter = '\0';
  std::size_t m_width = 0;
  bool m_isBig = false;
  bool m_isFortran = false;
};

/// The file as it is given, under names that the executions share.
struct Input {
  std::string_view bytes;
  std::size_t step = 1;  ///< Numbers or boxes that are read at once.
  std::size_t cut = 0;   ///< Bytes that the file loses while it is read.
  std::uint8_t seed = 0;

  [[nodiscard]] fs::path write() const { return folder().write("values.npy", bytes); }
  void writeCut() const { folder().write("values.npy", bytes.substr(0, bytes.size() - cut)); }
};

/// Calls an operation; returns whether it did not throw a FileError.
template <class Operation>
bool passes(const Operation& operation) {
  try {
    operation();
    return true;
  } catch (const FileError& error) {
    examine(error);
    return false;
  }
}

bool isSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool isSame(double value, const Number& number) { return isSame(value, number.real); }
bool isSame(std::uint32_t label, const Number& number) { return label == number.label; }

/// The file twice in a row, read part by part.
template <class Value>
void readParts(const Input& input, BoxValue kind, const Stored& stored) {
  const std::size_t size = stored.size();
  const fs::path path = input.write();
  scene::BoxValues values(Paths{path, path}, kind, 2 * size);
  for (std::size_t begin = 0; begin < 2 * size; begin += input.step) {
    std::vector<Value> part(std::min(input.step, 2 * size - begin));
    bool areTaken = true;
    for (std::size_t i = 0; i < part.size(); ++i) areTaken = areTaken && stored[(begin + i) % size].isTaken;
    require(passes([&] { values.read(begin, part); }) == areTaken,
            "all numbers that are taken are read, and no others");
    for (std::size_t i = 0; areTaken && i < part.size(); ++i)
      require(isSame(part[i], stored[(begin + i) % size]), "a number is read as the file has it");
  }
  if (input.cut == 0 || size == 0) return;
  scene::BoxValues cut(Paths{path}, kind, size);
  input.writeCut();
  std::vector<Value> last(1);
  require(!passes([&] { cut.read(size - 1, last); }), "a file that was cut is refused");
}

std::vector<Box> someBoxes(std::size_t count, std::uint8_t seed) {
  std::mt19937 random(seed);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<double>(random() % 8);
      box.max[axis] = box.min[axis] + 2.0;
    }
  }
  return boxes;
}

join::Budget littleOfAll() {
  join::Budget budget = test::tinyBudget();
  budget.cellBoxes = 20;
  return budget;
}

void joinValues(const Input& input, BoxValue kind, const Stored& stored) {
  Side side;
  side.boxes = someBoxes(stored.size(), input.seed);
  test::JoinCase with(side.boxes);
  const Paths paths{input.write()};
  bool areTaken = true;
  const std::array files{&with.values.margins, &with.values.groups, &with.values.categories, &with.values.masks};
  const std::array labels{&side.groups, &side.groups, &side.categories, &side.masks};
  *files[static_cast<std::size_t>(kind)] = paths;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const Number number = stored[i];
    areTaken = areTaken && number.isTaken;
    if (kind == BoxValue::Margin) {
      side.margins.push_back(number.real);
    } else {
      labels[static_cast<std::size_t>(kind)]->push_back(number.label);
    }
  }
  std::string bytes;
  require(passes([&] { bytes = with.run(with.options(), littleOfAll()); }) == areTaken,
          "boxes are joined if all that they have is taken");
  const OverlapOptions options;
  require(!areTaken || bytes == test::bytesOfPairs(Oracle{options, side, side}.pairs()),
          "a join gives the pairs of the double loop");
}

template <class Value>
void checkValues(const Input& input, BoxValue kind) {
  const fs::path path = input.write();
  const Stored stored(input.bytes, kind);
  const std::size_t size = stored.size();
  if (!passes([&] { (void)scene::BoxValues(Paths{path}, kind, size); })) return;
  require(kind == BoxValue::Margin || !stored.isFloat(), "only margins are floats");
  require(!passes([&] { (void)scene::BoxValues(Paths{path}, kind, size + 1); }), "there is a number for each box");
  readParts<Value>(input, kind, stored);
  if (size > 0 && size <= kMostJoined) joinValues(input, kind, stored);
}

template <class Float>
void readRows(const Input& input, scene::BoxRows& rows, const Stored& stored) {
  for (std::size_t begin = 0; begin < rows.size(); begin += input.step) {
    std::vector<Float> part(6 * std::min<std::size_t>(input.step, rows.size() - begin));
    rows.read(begin, part);
    for (std::size_t i = 0; i < part.size(); ++i)
      require(isSame(static_cast<double>(part[i]), stored.bound(begin + i / 6, i % 6)),
              "a bound is read as the file has it");
  }
}

void joinRows(const Input& input, const Stored& stored) {
  test::JoinCase with;
  with.paths = {input.write()};
  std::vector<Box> boxes(stored.size() / 6);
  bool areTaken = true;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < 6; ++k) (k < 3 ? boxes[i].min[k] : boxes[i].max[k - 3]) = stored.bound(i, k);
    areTaken = areTaken && !hasNan(boxes[i]);
  }
  std::string bytes;
  require(passes([&] { bytes = with.run(with.options(), littleOfAll()); }) == areTaken,
          "boxes without a NaN are joined");
  require(!areTaken || bytes == test::expectedBytes(boxes), "a join gives the pairs of the double loop");
}

void checkBoxes(const Input& input) {
  const fs::path path = input.write();
  if (!passes([&] { (void)scene::BoxRows(path); })) return;
  const Stored stored(input.bytes);
  scene::BoxRows rows(path);
  require(rows.size() * 6 == stored.size(), "a file has as many boxes as its bytes say");
  require(stored.isFloat() && stored.isFloat64() == rows.isFloat64(), "bounds are of the type that the file names");
  readRows<double>(input, rows, stored);
  if (!rows.isFloat64()) readRows<float>(input, rows, stored);
  if (rows.size() <= kMostJoined) joinRows(input, stored);
  if (input.cut == 0 || rows.size() == 0) return;
  input.writeCut();
  std::array<double, 6> last{};
  require(!passes([&] { rows.read(rows.size() - 1, last); }), "a file that was cut is refused");
}

void runValues(Bytes bytes) {
  constexpr std::size_t kChoices = 4, kMostParts = 64;
  if (bytes.size() <= kChoices) return;
  Choices choices(bytes.first(kChoices));
  const std::size_t kind = choices.below(5);
  Input input{.bytes = {reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
  input.bytes.remove_prefix(kChoices);
  input.step = std::max<std::size_t>(1 + choices.byte(), input.bytes.size() / kMostParts);
  input.cut = choices.byte() % input.bytes.size();
  input.seed = choices.byte();
  if (kind == 4) {
    checkBoxes(input);
  } else if (kind == 0) {
    checkValues<double>(input, BoxValue::Margin);
  } else {
    checkValues<std::uint32_t>(input, static_cast<BoxValue>(kind));
  }
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(values, allpairs::fuzz::runValues)
