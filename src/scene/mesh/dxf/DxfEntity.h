// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/MeshObject.h"
#include "mesh/Transform.h"

namespace allpairs::scene {

/// A group of a DXF: a code that says what the value is.
struct DxfGroup {
  std::int64_t code = 0;
  std::string_view value;
  std::size_t line = 0;  ///< Of the value.
};

/// An entity of a DXF, or what else begins with group 0: its kind and its groups, within the text of the file.
///
/// Bad input: asking for a number where the value is none throws FileError with its line.
class DxfEntity {
 public:
  DxfEntity(const std::filesystem::path& path, std::string_view kind, std::size_t line)
      : m_path(&path), m_kind(kind), m_line(line) {}

  [[nodiscard]] std::string_view kind() const { return m_kind; }
  [[nodiscard]] std::size_t line() const { return m_line; }
  [[nodiscard]] const std::vector<DxfGroup>& groups() const { return m_groups; }
  void add(const DxfGroup& group) {
    if (group.code == 8 && !m_layer) m_layer = group.value;
    m_groups.push_back(group);
  }

  /// Its layer, which is asked for at each of its shapes.
  [[nodiscard]] std::string_view layer() const { return m_layer.value_or("0"); }

  /// The value of the first group of that code; what is given where there is none.
  [[nodiscard]] std::string_view text(std::int64_t code, std::string_view otherwise = {}) const;
  [[nodiscard]] double number(std::int64_t code, double otherwise = 0.0) const;
  [[nodiscard]] std::int64_t integer(std::int64_t code, std::int64_t otherwise = 0) const;
  [[nodiscard]] bool has(std::int64_t code) const { return find(code) != nullptr; }

  /// The position whose coordinates have that code, and those of ten and twenty more. Old files give z once for all
  /// positions of an entity, as its elevation.
  [[nodiscard]] Point point(std::int64_t code) const;

  /// The same where it must be there.
  [[nodiscard]] Point requiredPoint(std::int64_t code) const;

  /// Whether its z is given, in either way.
  [[nodiscard]] bool hasZ(std::int64_t code) const;

  [[nodiscard]] double numberOf(const DxfGroup& group) const;

  /// From the entity's own coordinates to those of the block that it is in.
  /// Source: AutoCAD DXF Reference, "Arbitrary Axis Algorithm".
  [[nodiscard]] Transform plane() const;

  [[noreturn]] void fail(const std::string& problem) const { failAt(m_line, problem); }

 private:
  [[nodiscard]] const DxfGroup* find(std::int64_t code) const;
  [[noreturn]] void failAt(std::size_t line, const std::string& problem) const;

  const std::filesystem::path* m_path;
  std::string_view m_kind;
  std::size_t m_line;
  std::optional<std::string_view> m_layer;
  std::vector<DxfGroup> m_groups;
};

}  // namespace allpairs::scene
