// SPDX-License-Identifier: MIT
// Rows of six float32 in, pairs of two uint32 out, by CGAL::box_self_intersection_d: cgal_pairs BOXES PAIRS CUTOFF.
// Files are plain numbers without a header; bench/spatial compiles and calls it.
#include <CGAL/box_intersection_d.h>
#include <CGAL/version.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

struct Row {
  std::array<float, 3> min;
  std::array<float, 3> max;
};

/// As small as a box for CGAL can be.
struct NumberedBox {
  using NT = float;
  using ID = std::uint32_t;

  Row row;
  ID number;

  static int dimension() { return 3; }
  [[nodiscard]] float min_coord(int axis) const { return row.min[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] float max_coord(int axis) const { return row.max[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] ID id() const { return number; }
};

std::vector<NumberedBox> readBoxes(const char* path) {
  std::vector<Row> rows(std::filesystem::file_size(path) / sizeof(Row));
  std::ifstream(path, std::ios::binary)
      .read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(Row)));
  std::vector<NumberedBox> boxes;
  boxes.reserve(rows.size());
  for (const Row& row : rows) boxes.push_back({row, static_cast<std::uint32_t>(boxes.size())});
  return boxes;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::cout << CGAL_VERSION_STR << '\n';
    return 0;
  }
  std::vector<NumberedBox> boxes = readBoxes(arguments[1]);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto report = [&pairs](const NumberedBox& a, const NumberedBox& b) { pairs.emplace_back(a.number, b.number); };
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), report, std::stol(arguments[3]));
  std::ofstream(arguments[2], std::ios::binary)
      .write(reinterpret_cast<const char*>(pairs.data()),
             static_cast<std::streamsize>(pairs.size() * sizeof(pairs[0])));
}
