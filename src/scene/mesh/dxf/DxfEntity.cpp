// SPDX-License-Identifier: MIT
#include "mesh/dxf/DxfEntity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include "allpairs/scene/FileError.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

constexpr std::int64_t kY = 10;  // from the code of an x to that of its y
constexpr std::int64_t kZ = 20;
constexpr std::int64_t kElevation = 38;
constexpr std::int64_t kExtrusion = 210;

Point unit(const Point& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

}  // namespace

const DxfGroup* DxfEntity::find(std::int64_t code) const {
  const auto found =
      std::find_if(m_groups.begin(), m_groups.end(), [code](const DxfGroup& g) { return g.code == code; });
  return found == m_groups.end() ? nullptr : &*found;
}

std::string_view DxfEntity::text(std::int64_t code, std::string_view otherwise) const {
  const DxfGroup* group = find(code);
  return group == nullptr ? otherwise : group->value;
}

double DxfEntity::numberOf(const DxfGroup& group) const {
  const std::optional<double> value = parseFinite(group.value);
  if (!value) failAt(group.line, quotedWord(group.value) + " is no finite number");
  return *value;
}

double DxfEntity::number(std::int64_t code, double otherwise) const {
  const DxfGroup* group = find(code);
  return group == nullptr ? otherwise : numberOf(*group);
}

std::int64_t DxfEntity::integer(std::int64_t code, std::int64_t otherwise) const {
  const DxfGroup* group = find(code);
  std::int64_t value = otherwise;
  if (group != nullptr && parseWhole(group->value, value) != std::errc())
    failAt(group->line, quotedWord(group->value) + " is no integer");
  return value;
}

Point DxfEntity::point(std::int64_t code) const {
  const double z = number(has(code + kZ) ? code + kZ : kElevation);
  return {number(code), number(code + kY), z};
}

bool DxfEntity::hasZ(std::int64_t code) const { return has(code + kZ) || has(kElevation); }

Point DxfEntity::requiredPoint(std::int64_t code) const {
  if (!has(code) || !has(code + kY))
    fail("a " + std::string(shortWord(m_kind)) + " without group " + std::to_string(has(code) ? code + kY : code));
  return point(code);
}

Transform DxfEntity::plane() const {
  const Point given{number(kExtrusion), number(kExtrusion + kY), number(kExtrusion + kZ, 1.0)};
  const Point z = unit(given);
  if (!std::isfinite(z[0] + z[1] + z[2])) fail("its extrusion has no direction");
  constexpr double kNear = 1.0 / 64;  // as the reference has it
  const bool isUpright = std::abs(z[0]) < kNear && std::abs(z[1]) < kNear;
  const Point x = unit(cross(isUpright ? Point{0, 1, 0} : Point{0, 0, 1}, z));
  const Point y = cross(z, x);
  return {{{x[0], y[0], z[0], 0.0}, {x[1], y[1], z[1], 0.0}, {x[2], y[2], z[2], 0.0}}};
}

void DxfEntity::failAt(std::size_t line, const std::string& problem) const { throw FileError(*m_path, problem, line); }

}  // namespace allpairs::scene
