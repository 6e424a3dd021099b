// SPDX-License-Identifier: MIT
#include "Orientation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace allpairs::exact {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon() / 2.0;  // of one rounding
constexpr double kLineBound = (3.0 + 16.0 * kEpsilon) * kEpsilon;
constexpr double kPlaneBound = (7.0 + 56.0 * kEpsilon) * kEpsilon;

int signOf(double value) { return (value > 0.0 ? 1 : 0) - (value < 0.0 ? 1 : 0); }

/// A sum without rounding: numbers of which none has bits that another has too, the least first.
class ExactSum {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < m_count; ++i) {
      const double sum = value + m_parts[i];
      const double share = sum - value;
      const double rest = (value - (sum - share)) + (m_parts[i] - share);
      if (rest != 0.0) m_parts[kept++] = rest;
      value = sum;
    }
    if (value != 0.0) m_parts[kept++] = value;
    m_count = kept;
  }

  /// Adds a * b.
  void addProduct(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  /// Adds a * b * c.
  void addProduct(double a, double b, double c) {
    const double product = a * b;
    addProduct(std::fma(a, b, -product), c);
    addProduct(product, c);
  }

  [[nodiscard]] int sign() const { return m_count == 0 ? 0 : signOf(m_parts[m_count - 1]); }

 private:
  static constexpr std::size_t kMostParts = 97;  // 24 products of three numbers, of four parts each, and one to come

  std::array<double, kMostParts> m_parts{};
  std::size_t m_count = 0;
};

int exactSideOfLine(const Point& a, const Point& b, const Point& p) {
  ExactSum sum;
  sum.addProduct(a.y(), b.z());
  sum.addProduct(-a.z(), b.y());
  sum.addProduct(b.y(), p.z());
  sum.addProduct(-b.z(), p.y());
  sum.addProduct(p.y(), a.z());
  sum.addProduct(-p.z(), a.y());
  return sum.sign();
}

/// Adds the determinant of three rows, times `sign`.
void addDeterminant(ExactSum& sum, const Corners& rows, double sign) {
  const auto& [a, b, c] = rows;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    sum.addProduct(sign * a[i], b[j], c[k]);
    sum.addProduct(-sign * a[i], b[k], c[j]);
  }
}

/// (b - a) x (c - a) . (p - a), multiplied out.
int exactSideOfPlane(const Corners& corners, const Point& p) {
  const auto& [a, b, c] = corners;
  ExactSum sum;
  addDeterminant(sum, {b, c, p}, 1.0);
  addDeterminant(sum, {a, c, p}, -1.0);
  addDeterminant(sum, {a, b, p}, 1.0);
  addDeterminant(sum, {a, b, c}, -1.0);
  return sum.sign();
}

}  // namespace

int sideOfLine(const Point& from, const Point& to, const Point& point) {
  const double left = (to.y() - from.y()) * (point.z() - from.z());
  const double right = (to.z() - from.z()) * (point.y() - from.y());
  const double bound = kLineBound * (std::abs(left) + std::abs(right));
  if (bound == 0.0 || std::abs(left - right) > bound) return signOf(left - right);
  return exactSideOfLine(from, to, point);
}

int sideOfPlane(const Corners& corners, const Point& point) {
  const Point a = corners[0] - point;
  const Point b = corners[1] - point;
  const Point c = corners[2] - point;
  double value = 0.0;
  double bound = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    value -= a[i] * (b[j] * c[k] - b[k] * c[j]);
    bound += std::abs(a[i]) * (std::abs(b[j] * c[k]) + std::abs(b[k] * c[j]));
  }
  bound *= kPlaneBound;
  if (bound == 0.0 || std::abs(value) > bound) return signOf(value);
  return exactSideOfPlane(corners, point);
}

}  // namespace allpairs::exact
