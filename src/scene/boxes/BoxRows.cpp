// SPDX-License-Identifier: MIT
#include "allpairs/scene/BoxRows.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"
#include "boxes/NpyInput.h"
#include "input/FileBytes.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

void checkShape(const NpyHeader& header, std::uint64_t itemSize, const InputFile& file, const Path& path) {
  if (header.shape.size() != 2 || header.shape[1] != 6) {
    throw FileError(path, "has shape " + shapeText(header.shape) + "; boxes are (n, 6)");
  }
  requireLength(header, itemSize, file, path);
}

}  // namespace

struct BoxRows::State {
  explicit State(const Path& filePath) : path(filePath), file(filePath), header(readNpyHeader(file, filePath)) {
    isFloat64 = !holdsFloat32(header, path);
    dataBegin = file.position();
    checkShape(header, isFloat64 ? sizeof(double) : sizeof(float), file, path);
  }

  template <class Number>
  void read(std::uint64_t begin, std::span<Number> rows) {
    const std::uint64_t count = rows.size() / 6;
    const std::uint64_t size = header.shape[0];
    if (rows.size() % 6 != 0 || begin > size || count > size - begin) {
      throw InvalidArgument("boxes " + std::to_string(begin) + " to " + std::to_string(begin + count) + " of " +
                            std::to_string(size));
    }
    if (!header.fortranOrder) {
      readNumbers(6 * begin, rows);
      return;
    }
    column.resize(static_cast<std::size_t>(count) * sizeof(Number));
    const std::span<Number> numbers(reinterpret_cast<Number*>(column.data()), static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < 6; ++k) {
      readNumbers(k * size + begin, numbers);
      for (std::size_t i = 0; i < numbers.size(); ++i) rows[6 * i + k] = numbers[i];
    }
  }

  template <class Number>
  void readNumbers(std::uint64_t first, std::span<Number> numbers) {
    file.seek(dataBegin + first * sizeof(Number));
    file.read(numbers.data(), numbers.size_bytes());
    toNativeOrder(header, numbers.data(), numbers.size());
  }

  Path path;
  InputFile file;
  NpyHeader header;
  bool isFloat64 = false;
  std::uint64_t dataBegin = 0;
  std::vector<std::byte> column;  ///< Of a file in Fortran order.
  std::vector<float> narrow;      ///< Of a float32 file that is read as float64.
};

BoxRows::BoxRows(const Path& path) : m_state(std::make_unique<State>(path)) {}
BoxRows::~BoxRows() = default;
BoxRows::BoxRows(BoxRows&&) noexcept = default;
BoxRows& BoxRows::operator=(BoxRows&&) noexcept = default;

const Path& BoxRows::path() const noexcept { return m_state->path; }
std::uint64_t BoxRows::size() const noexcept { return m_state->header.shape[0]; }
bool BoxRows::isFloat64() const noexcept { return m_state->isFloat64; }

void BoxRows::read(std::uint64_t begin, Span<float> rows) {
  if (m_state->isFloat64) throw InvalidArgument("boxes of float64 do not fit in float32");
  m_state->read<float>(begin, rows);
}

void BoxRows::read(std::uint64_t begin, Span<double> rows) {
  State& state = *m_state;
  if (state.isFloat64) {
    state.read<double>(begin, rows);
    return;
  }
  state.narrow.resize(rows.size());
  state.read(begin, std::span(state.narrow));
  std::copy(state.narrow.begin(), state.narrow.end(), rows.begin());
}

}  // namespace allpairs::scene
