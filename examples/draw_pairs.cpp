// SPDX-License-Identifier: MIT
//
// Draws the boxes of a flat scene and the pairs that overlap, as an SVG picture: the one in README.md.
#include <allpairs/Overlaps.h>

#include <cstdint>
#include <iostream>
#include <vector>

namespace {

constexpr int kWidth = 720;
constexpr int kHeight = 300;
constexpr int kCount = 60;

/// The next of a fixed sequence of numbers from 0 to limit - 1 (constants of Numerical Recipes, section 7.1).
int next(std::uint32_t& state, int limit) {
  state = 1664525U * state + 1013904223U;
  return static_cast<int>((state >> 8U) % static_cast<std::uint32_t>(limit));
}

std::vector<allpairs::Box> scatter() {
  std::uint32_t state = 7;
  std::vector<allpairs::Box> boxes(kCount);
  for (allpairs::Box& box : boxes) {
    const int width = 14 + next(state, 46);
    const int height = 14 + next(state, 46);
    const int x = 4 + next(state, kWidth - 8 - width);
    const int y = 4 + next(state, kHeight - 8 - height);
    box = {{static_cast<double>(x), static_cast<double>(y), 0.0},
           {static_cast<double>(x + width), static_cast<double>(y + height), 0.0}};
  }
  return boxes;
}

double middle(const allpairs::Box& box, std::size_t axis) { return (box.min[axis] + box.max[axis]) / 2; }

}  // namespace

int main() {
  const std::vector<allpairs::Box> boxes = scatter();
  const std::vector<allpairs::Pair> pairs = allpairs::overlaps(boxes);
  std::vector<bool> paired(boxes.size());
  for (const auto& [first, second] : pairs) paired[first] = paired[second] = true;

  std::cout << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << kWidth << ' ' << kHeight << "\">\n"
            << "<style>rect{fill:#9aa5b1;fill-opacity:.12;stroke:#9aa5b1;stroke-width:1.5}"
            << ".p{fill:#f08c00;fill-opacity:.28;stroke:#f08c00}line{stroke:#1971c2;stroke-width:2.5}</style>\n";
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const allpairs::Box& box = boxes[i];
    std::cout << "<rect" << (paired[i] ? " class=\"p\"" : "") << " x=\"" << box.min[0] << "\" y=\"" << box.min[1]
              << "\" width=\"" << box.max[0] - box.min[0] << "\" height=\"" << box.max[1] - box.min[1] << "\"/>\n";
  }
  for (const auto& [first, second] : pairs) {
    std::cout << "<line x1=\"" << middle(boxes[first], 0) << "\" y1=\"" << middle(boxes[first], 1) << "\" x2=\""
              << middle(boxes[second], 0) << "\" y2=\"" << middle(boxes[second], 1) << "\"/>\n";
  }
  std::cout << "</svg>\n";
}
