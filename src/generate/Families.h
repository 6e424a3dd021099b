// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace allpairs::generate {

/// Writes boxes as rows of 6 floats.
class Rows {
 public:
  explicit Rows(std::size_t count) { m_values.reserve(6 * count); }

  void add(const std::array<double, 3>& min, const std::array<double, 3>& max) {
    for (const double bound : min) m_values.push_back(static_cast<float>(bound));
    for (const double bound : max) m_values.push_back(static_cast<float>(bound));
  }

  void addAround(const std::array<double, 3>& centre, const std::array<double, 3>& size) {
    std::array<double, 3> min{};
    std::array<double, 3> max{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      min[axis] = centre[axis] - 0.5 * size[axis];
      max[axis] = centre[axis] + 0.5 * size[axis];
    }
    add(min, max);
  }

  [[nodiscard]] std::vector<float> take() && { return std::move(m_values); }

 private:
  std::vector<float> m_values;
};

// One function for each scene; boxScenes() says what they are.
[[nodiscard]] std::vector<float> uniformBoxes(std::size_t count, std::uint64_t seed);
[[nodiscard]] std::vector<float> clusteredBoxes(std::size_t count, std::uint64_t seed);
[[nodiscard]] std::vector<float> powerLawBoxes(std::size_t count, std::uint64_t seed);
[[nodiscard]] std::vector<float> cityBoxes(std::size_t count, std::uint64_t seed);
[[nodiscard]] std::vector<float> needleBoxes(std::size_t count, std::uint64_t seed);
[[nodiscard]] std::vector<float> overlappingBoxes(std::size_t count, std::uint64_t seed);
[[nodiscard]] std::vector<float> triangleBoxes(std::size_t count, std::uint64_t seed);

}  // namespace allpairs::generate
