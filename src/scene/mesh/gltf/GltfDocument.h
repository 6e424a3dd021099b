// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/ReadScope.h"
#include "mesh/gltf/JsonTree.h"

namespace allpairs::scene {

/// One entry of a list of a glTF document: node 3, accessor 7.
struct GltfItem {
  const nlohmann::json* json;
  std::string name;
};

/// A glTF 2.0 document, as JSON or as GLB, with its buffers. Every index, length and count is checked when it is asked
/// for.
///
/// Bad input: throws FileError that names the item; never its content.
/// Reference: Khronos Group, glTF 2.0 Specification.
class GltfDocument {
 public:
  GltfDocument(const std::filesystem::path& path, ReadScope& scope);

  [[nodiscard]] const nlohmann::json& root() const noexcept { return m_json.root; }
  [[nodiscard]] ReadScope& scope() const noexcept { return m_scope; }

  /// How long a list is; 0 where there is none.
  [[nodiscard]] std::size_t size(const char* list) const;
  [[nodiscard]] GltfItem item(const char* list, std::uint64_t index) const;
  /// A part of an item that is an object; null where there is none.
  [[nodiscard]] std::optional<GltfItem> part(const GltfItem& item, const char* key) const;
  /// A number that is a count, an offset or an index.
  [[nodiscard]] std::optional<std::uint64_t> count(const GltfItem& item, const char* key) const;
  [[nodiscard]] std::uint64_t needCount(const GltfItem& item, const char* key) const;
  /// Whether it is true; false where it is not there.
  [[nodiscard]] bool flag(const GltfItem& item, const char* key) const;
  /// A list of indices.
  [[nodiscard]] std::vector<std::uint64_t> indices(const GltfItem& item, const char* key) const;
  /// A list of exactly `size` numbers; empty if absent.
  [[nodiscard]] std::vector<double> numbers(const GltfItem& item, const char* key, std::size_t size) const;
  [[nodiscard]] std::string text(const GltfItem& item, const char* key) const;
  [[nodiscard]] bool hasExtension(const GltfItem& item, const char* name) const;
  /// The names of the extensions without which, as the document says, it cannot be read; none that has the form of no
  /// name.
  [[nodiscard]] std::vector<std::string> requiredExtensions() const;

  /// The bytes of a buffer view.
  [[nodiscard]] std::string_view view(const GltfItem& view);

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void parse(std::string_view json);
  void readChunks();
  std::string_view buffer(std::uint64_t index);
  std::string loadBuffer(const GltfItem& buffer) const;

  std::filesystem::path m_path;
  ReadScope& m_scope;
  std::string m_bytes;
  JsonTree m_json;
  std::optional<std::string_view> m_binary;  ///< The second chunk of a GLB.
  std::vector<std::optional<std::string>> m_buffers;
};

/// The entries of an accessor, each of `width` numbers, one after the other; sparse ones filled in.
[[nodiscard]] std::vector<double> readGltfAccessor(GltfDocument& document, std::uint64_t index, std::size_t width);

}  // namespace allpairs::scene
