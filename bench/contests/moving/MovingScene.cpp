// SPDX-License-Identifier: MIT
#include "MovingScene.h"

#include <algorithm>
#include <cmath>

namespace allpairs::bench {

std::span<const Motion> motions() {
  static const std::vector<Motion> all{
      {"straight", 1.0, true, 0.1},
      {"brownian", 1.0, false, 0.1},
      {"one-percent", 0.01, true, 0.1},
      {"slow", 1.0, true, 0.01},
  };
  return all;
}

MovingScene::MovingScene(const Motion& motion, std::size_t boxes, std::uint64_t seed)
    : m_motion(motion), m_side(std::cbrt(static_cast<double>(boxes) / 0.1)), m_random(seed) {
  for (std::size_t i = 0; i < boxes; ++i) {
    m_centres.push_back({m_side * uniform(), m_side * uniform(), m_side * uniform()});
    m_velocities.push_back(direction());
    if (uniform() < motion.movingShare) m_ids.push_back(static_cast<BoxId>(i));
  }
  m_rows.resize(6 * boxes);
  m_movingRows.resize(6 * m_ids.size());
  for (std::size_t i = 0; i < boxes; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m_rows[6 * i + axis] = static_cast<float>(m_centres[i][axis] - 0.5);
      m_rows[6 * i + axis + 3] = static_cast<float>(m_centres[i][axis] + 0.5);
    }
  }
  write();
}

std::array<double, 3> MovingScene::direction() {
  for (;;) {
    std::array<double, 3> way{2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1};
    const double length = std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    if (length > 1.0 || length < 0.1) continue;
    for (double& component : way) component *= m_motion.length / length;
    return way;
  }
}

void MovingScene::advance() {
  for (const BoxId id : m_ids) {
    if (!m_motion.straight) m_velocities[id] = direction();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& centre = m_centres[id][axis];
      double& velocity = m_velocities[id][axis];
      centre += velocity;
      if ((centre < 0.0 && velocity < 0.0) || (centre > m_side && velocity > 0.0)) velocity = -velocity;
    }
  }
  write();
}

void MovingScene::write() {
  for (std::size_t k = 0; k < m_ids.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t row = std::size_t{6} * m_ids[k];
      m_rows[row + axis] = static_cast<float>(m_centres[m_ids[k]][axis] - 0.5);
      m_rows[row + axis + 3] = static_cast<float>(m_centres[m_ids[k]][axis] + 0.5);
    }
    std::copy_n(&m_rows[std::size_t{6} * m_ids[k]], 6, &m_movingRows[6 * k]);
  }
}

}  // namespace allpairs::bench
