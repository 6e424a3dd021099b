// SPDX-License-Identifier: MIT
#include "mesh/gltf/GltfDocument.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/ByteOrder.h"
#include "input/FileBytes.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxJsonDepth = 200;     // of arrays and objects in each other; glTF itself needs eight
constexpr std::uint64_t kBytesPerValue = 100;  // of JSON in memory, the node of an object and its key included
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

std::optional<unsigned> base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
  if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a' + 26);
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0' + 52);
  if (c == '+') return 62;
  if (c == '/') return 63;
  return std::nullopt;
}

/// The bytes that a base64 text stands for; nothing if it is none.
std::optional<std::string> decodeBase64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::optional<unsigned> digit = base64Digit(c);
    if (!digit) return std::nullopt;
    bits = bits << 6 | *digit;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// The name of a file in a uri, in which "%20" is a blank.
std::string fileNameOf(std::string_view uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool isEscape = uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 && hexDigit(uri[i + 2]) >= 0;
    name += isEscape ? static_cast<char>(16 * hexDigit(uri[i + 1]) + hexDigit(uri[i + 2])) : uri[i];
    if (isEscape) i += 2;
  }
  return name;
}

/// What a list's entries are called: the first of "accessors" is "accessor 0".
std::string itemName(std::string_view list, std::uint64_t index) {
  list.remove_suffix(list == "meshes" ? 2 : 1);
  return std::string(list) + ' ' + std::to_string(index);
}

}  // namespace

GltfDocument::GltfDocument(const std::filesystem::path& path, ReadScope& scope)
    : m_path(path), m_scope(scope), m_bytes(readText(path, scope.stop())) {
  if (m_bytes.starts_with("glTF")) {
    readChunks();
  } else {
    parse(m_bytes);
  }
  if (!m_json.root.is_object()) fail("is no glTF: it is no JSON object");
  const auto asset = m_json.root.find("asset");
  const std::string version = asset != m_json.root.end() ? text({&*asset, "asset"}, "version") : "";
  if (version.starts_with("1") || (m_json.root.contains("meshes") && m_json.root["meshes"].is_object())) {
    fail("is glTF 1.0; only glTF 2.0 is read");
  }
  m_buffers.resize(size("buffers"));
}

void GltfDocument::parse(std::string_view json) {
  const auto isStructure = [](char c) { return c == ',' || c == '[' || c == '{'; };
  m_scope.take(kBytesPerValue * static_cast<std::uint64_t>(std::count_if(json.begin(), json.end(), isStructure)));
  const std::optional<JsonProblem> problem = m_json.parse(json, kMaxJsonDepth);
  if (!problem) return;
  if (problem->isTooDeep) fail("is nested more than " + std::to_string(kMaxJsonDepth) + " deep");
  fail("is no well-formed JSON" + (problem->byte ? " at byte " + std::to_string(*problem->byte) : ""));
}

void GltfDocument::readChunks() {
  std::string_view rest = m_bytes;
  if (rest.size() < kGlbHeader + kChunkHeader) fail("truncated: it is too short for a GLB file");
  const auto version = littleEndian<std::uint32_t>(rest.substr(4));
  const auto length = littleEndian<std::uint32_t>(rest.substr(8));
  if (version != 2) fail("is GLB of version " + std::to_string(version) + "; only 2 is read");
  if (length > rest.size()) {
    fail("truncated: the header promises " + std::to_string(length) + " bytes, the file has " +
         std::to_string(rest.size()));
  }
  requireFilling(rest.substr(length), m_path);
  rest = rest.substr(kGlbHeader, std::max<std::size_t>(length, kGlbHeader) - kGlbHeader);
  bool hasJson = false;
  while (rest.size() >= kChunkHeader) {
    const auto size = littleEndian<std::uint32_t>(rest);
    const auto type = littleEndian<std::uint32_t>(rest.substr(4));
    rest.remove_prefix(kChunkHeader);
    if (size > rest.size()) {
      fail("truncated: a chunk promises " + std::to_string(size) + " bytes, the file has " +
           std::to_string(rest.size()));
    }
    if (!hasJson && type != kJsonChunk) fail("is no glTF: its first chunk is not JSON");
    if (!hasJson) parse(rest.substr(0, size));
    if (hasJson && type == kBinaryChunk && !m_binary) m_binary = rest.substr(0, size);
    hasJson = true;
    rest.remove_prefix(size);
  }
  if (!hasJson) fail("is no glTF: it has no JSON");
}

std::size_t GltfDocument::size(const char* list) const {
  const auto found = m_json.root.find(list);
  if (found == m_json.root.end()) return 0;
  if (!found->is_array()) fail(std::string("'") + list + "' is no list");
  return found->size();
}

GltfItem GltfDocument::item(const char* list, std::uint64_t index) const {
  if (index >= size(list)) fail("there is no " + itemName(list, index));
  GltfItem item{&m_json.root[list][static_cast<std::size_t>(index)], itemName(list, index)};
  if (!item.json->is_object()) fail(item.name + " is no object");
  return item;
}

std::optional<GltfItem> GltfDocument::part(const GltfItem& item, const char* key) const {
  const auto found = item.json->find(key);
  if (found == item.json->end()) return std::nullopt;
  if (!found->is_object()) fail(item.name + ": '" + key + "' is no object");
  return GltfItem{&*found, item.name};
}

std::optional<std::uint64_t> GltfDocument::count(const GltfItem& item, const char* key) const {
  const auto found = item.json->find(key);
  if (found == item.json->end()) return std::nullopt;
  if (found->is_number_unsigned()) return found->get<std::uint64_t>();
  constexpr double kMost = 0x1p53;  // up to which a double holds every whole number
  const double value = found->is_number() ? found->get<double>() : -1.0;
  if (!(value >= 0.0) || value > kMost || value != std::floor(value)) fail(item.name + ": '" + key + "' is no count");
  return static_cast<std::uint64_t>(value);
}

std::uint64_t GltfDocument::needCount(const GltfItem& item, const char* key) const {
  const std::optional<std::uint64_t> value = count(item, key);
  if (!value) fail(item.name + " has no '" + key + "'");
  return *value;
}

bool GltfDocument::flag(const GltfItem& item, const char* key) const {
  const auto found = item.json->find(key);
  if (found == item.json->end()) return false;
  if (!found->is_boolean()) fail(item.name + ": '" + key + "' is neither true nor false");
  return found->get<bool>();
}

std::vector<std::uint64_t> GltfDocument::indices(const GltfItem& item, const char* key) const {
  std::vector<std::uint64_t> result;
  const auto found = item.json->find(key);
  if (found == item.json->end()) return result;
  if (!found->is_array()) fail(item.name + ": '" + key + "' is no list");
  for (const Json& value : *found) {
    if (!value.is_number_unsigned()) fail(item.name + ": '" + key + "' holds something that is no index");
    result.push_back(value.get<std::uint64_t>());
  }
  return result;
}

std::vector<double> GltfDocument::numbers(const GltfItem& item, const char* key, std::size_t size) const {
  std::vector<double> result;
  const auto found = item.json->find(key);
  if (found == item.json->end()) return result;
  if (!found->is_array() || found->size() != size) {
    fail(item.name + ": '" + key + "' is no list of " + std::to_string(size) + " numbers");
  }
  for (const Json& value : *found) {
    if (!value.is_number()) fail(item.name + ": '" + key + "' holds something that is no number");
    result.push_back(value.get<double>());
  }
  return result;
}

std::string GltfDocument::text(const GltfItem& item, const char* key) const {
  const auto found = item.json->is_object() ? item.json->find(key) : item.json->end();
  return found != item.json->end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool GltfDocument::hasExtension(const GltfItem& item, const char* name) const {
  const std::optional<GltfItem> extensions = part(item, "extensions");
  return extensions && extensions->json->contains(name);
}

std::vector<std::string> GltfDocument::requiredExtensions() const {
  std::vector<std::string> names;
  const auto list = root().find("extensionsRequired");
  if (list == root().end() || !list->is_array()) return names;
  constexpr std::size_t kLongest = 64;  // characters; names of extensions have half of that
  for (const Json& entry : *list) {
    if (!entry.is_string()) continue;
    const auto& name = entry.get_ref<const std::string&>();
    const auto isPart = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
    if (name.size() <= kLongest && std::all_of(name.begin(), name.end(), isPart)) names.push_back(name);
  }
  return names;
}

std::string_view GltfDocument::view(const GltfItem& view) {
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (hasExtension(view, extension)) fail(view.name + " is compressed by " + extension + ", which is not read");
  }
  const std::string_view bytes = buffer(needCount(view, "buffer"));
  const std::uint64_t offset = count(view, "byteOffset").value_or(0);
  const std::uint64_t length = needCount(view, "byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail("truncated: " + view.name + " promises " + std::to_string(length) + " bytes from " + std::to_string(offset) +
         ", its buffer has " + std::to_string(bytes.size()));
  }
  return bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::string_view GltfDocument::buffer(std::uint64_t index) {
  const GltfItem buffer = item("buffers", index);
  std::optional<std::string>& loaded = m_buffers[static_cast<std::size_t>(index)];
  const bool isChunk = index == 0 && m_binary && !buffer.json->contains("uri");
  if (!isChunk && !loaded) loaded = loadBuffer(buffer);
  const std::string_view bytes = isChunk ? *m_binary : std::string_view(*loaded);
  const std::uint64_t promised = needCount(buffer, "byteLength");
  if (promised > bytes.size()) {
    fail("truncated: " + buffer.name + " promises " + std::to_string(promised) + " bytes, there are " +
         std::to_string(bytes.size()));
  }
  return bytes.substr(0, static_cast<std::size_t>(promised));
}

std::string GltfDocument::loadBuffer(const GltfItem& buffer) const {
  const std::string uri = text(buffer, "uri");
  if (uri.empty()) fail(buffer.name + " has no uri");
  if (lowerCase(std::string_view(uri).substr(0, 5)) != "data:") {
    const ReadScope::Found file = m_scope.find(fileNameOf(uri), m_path);
    if (!file.problem.empty()) fail(buffer.name + ": the file '" + uri + "' " + file.problem);
    m_scope.admit(file.path);
    return readText(file.path, m_scope.stop());
  }
  constexpr std::string_view kEncoding = ";base64";
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(kEncoding)) {
    fail(buffer.name + " has a data uri that is not in base64");
  }
  m_scope.take(uri.size());
  std::optional<std::string> bytes = decodeBase64(std::string_view(uri).substr(comma + 1));
  if (!bytes) fail(buffer.name + " has a data uri that is not in base64");
  return std::move(*bytes);
}

void GltfDocument::fail(const std::string& problem) const { throw FileError(m_path, problem); }

}  // namespace allpairs::scene
