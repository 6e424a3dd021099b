// SPDX-License-Identifier: MIT
#include "allpairs/scene/BoxValues.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"
#include "boxes/NpyInput.h"
#include "input/FileBytes.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

struct Words {
  std::string_view one;
  std::string_view many;
};

Words wordsOf(BoxValue kind) {
  constexpr std::array<Words, 4> kWords{
      {{"margin", "margins"}, {"group", "groups"}, {"category", "categories"}, {"mask", "masks"}}};
  return kWords.at(static_cast<std::size_t>(kind));
}

/// A number of 16 bits, for which C++20 has no type.
struct Half {
  std::uint16_t bits = 0;
};

/// A NumPy bool.
struct Truth {
  std::uint8_t byte = 0;
};

/// Calls use(a number of the stored type), or says that it is none that is taken.
template <class Use>
bool withStoredType(std::string_view type, BoxValue kind, const Use& use) {
  const auto calledIf = [&](std::string_view name, auto number) {
    if (type != name) return false;
    use(number);
    return true;
  };
  if (kind == BoxValue::Margin && (calledIf("f2", Half{}) || calledIf("f4", float{}) || calledIf("f8", double{})))
    return true;
  return calledIf("b1", Truth{}) || calledIf("u1", std::uint8_t{}) || calledIf("u2", std::uint16_t{}) ||
         calledIf("u4", std::uint32_t{}) || calledIf("u8", std::uint64_t{}) || calledIf("i1", std::int8_t{}) ||
         calledIf("i2", std::int16_t{}) || calledIf("i4", std::int32_t{}) || calledIf("i8", std::int64_t{});
}

/// A stored number in a type that holds each of its kind.
template <class Stored>
auto widest(Stored number) {
  if constexpr (std::is_floating_point_v<Stored>) {
    return static_cast<double>(number);
  } else {
    return static_cast<std::conditional_t<std::is_signed_v<Stored>, std::int64_t, std::uint64_t>>(number);
  }
}

std::uint64_t widest(Truth truth) { return truth.byte != 0 ? 1 : 0; }

double widest(Half half) {
  const int exponent = half.bits >> 10 & 31;
  const int fraction = half.bits & 1023;
  double magnitude = std::ldexp(exponent == 0 ? fraction : fraction + 1024, std::max(exponent, 1) - 25);
  if (exponent == 31) magnitude = fraction == 0 ? std::numeric_limits<double>::infinity() : std::nan("");
  return (half.bits >> 15) != 0 ? -magnitude : magnitude;
}

constexpr std::int64_t kExactIntegers = std::int64_t{1} << 53;  // up to here float64 holds every integer

/// Whether a number of a file can be the Number of a box.
template <class Number, class Value>
bool isTaken(Value value) {
  if constexpr (std::is_floating_point_v<Value>) {
    return value > -std::numeric_limits<double>::infinity();  // no NaN is
  } else if constexpr (std::is_floating_point_v<Number>) {
    return std::cmp_less_equal(value, kExactIntegers) && std::cmp_greater_equal(value, -kExactIntegers);
  } else {
    return std::in_range<std::uint32_t>(value);
  }
}

template <class Number, class Value>
[[noreturn]] void failAt(const Path& path, std::uint64_t row, Value value) {
  const std::string number = std::to_string(row) + " is ";
  if constexpr (std::is_floating_point_v<Value>) {
    throw FileError(path, "margin " + number + (std::isnan(value) ? "a NaN" : "-infinity"));
  } else if constexpr (std::is_floating_point_v<Number>) {
    throw FileError(path, "margin " + number + std::to_string(value) + "; float64 holds integers up to 2^53");
  } else {
    throw FileError(path, "number " + number + std::to_string(value) + "; 0 to 4294967295 are taken");
  }
}

/// One file, of which the header has been read.
class ValueFile {
 public:
  ValueFile(const Path& path, BoxValue kind) : m_path(path), m_kind(kind), m_file(path) {
    m_header = readNpyHeader(m_file, path);
    m_begin = m_file.position();
    const std::string_view descr = m_header.descr;
    if (!descr.empty())
      m_type = descr.substr(std::string_view("<>|=").find(descr[0]) == std::string_view::npos ? 0 : 1);
    if (!withStoredType(m_type, kind, [this](auto number) { m_itemSize = sizeof(number); })) {
      throw FileError(path, "holds numbers of type '" + m_header.descr + "'; " + std::string(wordsOf(kind).many) +
                                (kind == BoxValue::Margin ? " are floats or integers" : " are integers"));
    }
    checkShape();
  }

  ValueFile(const ValueFile&) = delete;
  ValueFile& operator=(const ValueFile&) = delete;

  [[nodiscard]] std::uint64_t size() const { return m_header.shape[0]; }

  template <class Number>
  void read(std::uint64_t begin, std::span<Number> numbers) {
    withStoredType(m_type, m_kind, [&](auto stored) { readAs<decltype(stored)>(begin, numbers); });
  }

 private:
  void checkShape() const {
    if (m_header.shape.size() != 1) {
      throw FileError(
          m_path, "has shape " + shapeText(m_header.shape) + "; " + std::string(wordsOf(m_kind).many) + " are (n,)");
    }
    requireLength(m_header, m_itemSize, m_file, m_path);
  }

  template <class Stored, class Number>
  void readAs(std::uint64_t begin, std::span<Number> numbers) {
    m_bytes.resize(numbers.size() * sizeof(Stored));
    auto* const stored = reinterpret_cast<Stored*>(m_bytes.data());
    m_file.seek(m_begin + begin * sizeof(Stored));
    m_file.read(stored, m_bytes.size());
    toNativeOrder(m_header, stored, numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto value = widest(stored[i]);
      if (!isTaken<Number>(value)) failAt<Number>(m_path, begin + i, value);
      numbers[i] = static_cast<Number>(value);
    }
  }

  Path m_path;
  BoxValue m_kind;
  InputFile m_file;
  NpyHeader m_header;
  std::string_view m_type;  ///< Without the byte order; a part of the header.
  std::uint64_t m_begin = 0;
  std::size_t m_itemSize = 0;
  std::vector<std::byte> m_bytes;
};

}  // namespace

struct BoxValues::State {
  State(std::span<const Path> given, BoxValue valueKind, std::uint64_t boxes)
      : paths(given.begin(), given.end()), kind(valueKind) {
    for (const Path& path : paths) ends.push_back((ends.empty() ? 0 : ends.back()) + ValueFile(path, kind).size());
    const std::uint64_t all = ends.empty() ? 0 : ends.back();
    if (all == boxes) return;
    const Words words = wordsOf(kind);
    const std::string place = paths.size() > 1 ? "makes, with the files before it, " : "has ";
    throw FileError(paths.empty() ? Path() : paths.back(),
                    place + std::to_string(all) + ' ' + std::string(all == 1 ? words.one : words.many) + " for " +
                        std::to_string(boxes) + (boxes == 1 ? " box" : " boxes"));
  }

  template <class Number>
  void read(std::uint64_t begin, std::span<Number> numbers) {
    if ((kind == BoxValue::Margin) != std::is_same_v<Number, double>) {
      throw InvalidArgument(std::string(wordsOf(kind).many) + " are numbers of another type");
    }
    const std::uint64_t all = ends.empty() ? 0 : ends.back();
    if (begin > all || numbers.size() > all - begin) throw InvalidArgument("numbers that are not in the files");
    while (!numbers.empty()) {
      const auto place = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), begin) - ends.begin());
      const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(numbers.size(), ends[place] - begin));
      open(place);
      file->read(begin - beginOf(place), numbers.first(part));
      numbers = numbers.subspan(part);
      begin += part;
    }
  }

  [[nodiscard]] std::uint64_t beginOf(std::size_t place) const { return place == 0 ? 0 : ends[place - 1]; }

  void open(std::size_t place) {
    if (file && isOpen == place) return;
    file.reset();
    file = std::make_unique<ValueFile>(paths[place], kind);
    isOpen = place;
    if (file->size() != ends[place] - beginOf(place)) throw FileError(paths[place], "changed while it was read");
  }

  std::vector<Path> paths;
  BoxValue kind;
  std::vector<std::uint64_t> ends;  ///< Of each file, behind its last number.
  std::unique_ptr<ValueFile> file;
  std::size_t isOpen = 0;  ///< Which file that is.
};

BoxValues::BoxValues(Span<const Path> paths, BoxValue kind, std::uint64_t boxes)
    : m_state(std::make_unique<State>(paths, kind, boxes)) {}
BoxValues::~BoxValues() = default;
BoxValues::BoxValues(BoxValues&&) noexcept = default;
BoxValues& BoxValues::operator=(BoxValues&&) noexcept = default;

void BoxValues::read(std::uint64_t begin, Span<double> margins) { m_state->read<double>(begin, margins); }
void BoxValues::read(std::uint64_t begin, Span<std::uint32_t> labels) { m_state->read<std::uint32_t>(begin, labels); }

}  // namespace allpairs::scene
