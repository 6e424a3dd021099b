// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <utility>

#include "input/ByteOrder.h"
#include "mesh/gltf/GltfDocument.h"

namespace allpairs::scene {
namespace {

/// How numbers lie in a buffer view.
struct Layout {
  std::uint64_t componentType = 0;
  bool normalized = false;
  std::size_t width = 1;     ///< Numbers of an entry.
  std::uint64_t stride = 0;  ///< From entry to entry; 0 where they are one behind the other.
};

std::size_t componentSize(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

template <class T>
double component(std::string_view bytes, bool normalized) {
  const auto value = static_cast<double>(littleEndian<T>(bytes));
  if constexpr (std::is_floating_point_v<T>) return value;
  return normalized ? std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : value;
}

double readComponent(std::string_view bytes, const Layout& layout) {
  switch (layout.componentType) {
    case 5120:
      return component<std::int8_t>(bytes, layout.normalized);
    case 5121:
      return component<std::uint8_t>(bytes, layout.normalized);
    case 5122:
      return component<std::int16_t>(bytes, layout.normalized);
    case 5123:
      return component<std::uint16_t>(bytes, layout.normalized);
    case 5125:
      return component<std::uint32_t>(bytes, layout.normalized);
    default:
      return component<float>(bytes, layout.normalized);
  }
}

std::size_t widthOf(const std::string& type) {
  static constexpr std::array<std::pair<const char*, std::size_t>, 4> kTypes{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}}};
  const auto known = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& entry) { return type == entry.first; });
  return known == kTypes.end() ? 0 : known->second;
}

class AccessorReader {
 public:
  AccessorReader(GltfDocument& document, GltfItem accessor) : m_document(document), m_accessor(std::move(accessor)) {}

  std::vector<double> read(std::size_t width) {
    const std::uint64_t count = m_document.needCount(m_accessor, "count");
    Layout layout{.componentType = m_document.needCount(m_accessor, "componentType"), .width = width};
    layout.normalized = m_document.flag(m_accessor, "normalized");
    if (widthOf(m_document.text(m_accessor, "type")) != width) m_document.fail(m_accessor.name + " is of another type");
    std::vector<double> values;
    if (const auto view = m_document.count(m_accessor, "bufferView")) {
      values = entries(*view, m_document.count(m_accessor, "byteOffset").value_or(0), count, layout);
    } else {
      values.resize(charge(count, width));
    }
    if (const auto sparse = m_document.part(m_accessor, "sparse")) fill(values, *sparse, layout);
    return values;
  }

 private:
  /// The numbers of that many entries.
  std::size_t charge(std::uint64_t count, std::size_t width) const {
    m_document.scope().takeElements(count, width * sizeof(double));
    return static_cast<std::size_t>(count) * width;
  }

  std::vector<double> entries(std::uint64_t viewIndex, std::uint64_t offset, std::uint64_t count,
                              const Layout& layout) const {
    const GltfItem view = m_document.item("bufferViews", viewIndex);
    const std::string_view bytes = m_document.view(view);
    const std::size_t size = componentSize(layout.componentType);
    if (size == 0) m_document.fail(m_accessor.name + " has numbers of an unknown type");
    const std::uint64_t entry = size * layout.width;
    const std::uint64_t stride = m_document.count(view, "byteStride").value_or(entry);
    if (stride < entry || offset > bytes.size()) m_document.fail(m_accessor.name + " does not fit its buffer view");
    const std::uint64_t room = bytes.size() - offset;
    const std::uint64_t fitting = room < entry ? 0 : (room - entry) / stride + 1;
    if (count > fitting) {
      m_document.fail("truncated: " + m_accessor.name + " promises " + std::to_string(count) +
                      " entries, its buffer view has " + std::to_string(fitting));
    }
    std::vector<double> values;
    values.reserve(charge(count, layout.width));
    for (std::uint64_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < layout.width; ++k) {
        values.push_back(readComponent(bytes.substr(static_cast<std::size_t>(offset + i * stride + k * size)), layout));
      }
    }
    return values;
  }

  /// Puts the entries that are given one by one in their places.
  void fill(std::vector<double>& values, const GltfItem& sparse, const Layout& layout) const {
    const auto indices = m_document.part(sparse, "indices");
    const auto given = m_document.part(sparse, "values");
    if (!indices || !given) m_document.fail(m_accessor.name + ": 'sparse' needs indices and values");
    const std::uint64_t count = m_document.needCount(sparse, "count");
    const auto list = [&](const GltfItem& item, const Layout& as) {
      const std::uint64_t offset = m_document.count(item, "byteOffset").value_or(0);
      return entries(m_document.needCount(item, "bufferView"), offset, count, as);
    };
    const std::vector<double> places = list(*indices, {m_document.needCount(*indices, "componentType"), false, 1});
    const std::vector<double> filling = list(*given, layout);
    const std::size_t entryCount = values.size() / layout.width;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!(places[i] >= 0.0) || places[i] >= static_cast<double>(entryCount)) {
        m_document.fail(m_accessor.name + ": 'sparse' names an entry that isn't there");
      }
      const std::size_t place = static_cast<std::size_t>(places[i]) * layout.width;
      for (std::size_t k = 0; k < layout.width; ++k) values[place + k] = filling[i * layout.width + k];
    }
  }

  GltfDocument& m_document;
  GltfItem m_accessor;
};

}  // namespace

std::vector<double> readGltfAccessor(GltfDocument& document, std::uint64_t index, std::size_t width) {
  return AccessorReader(document, document.item("accessors", index)).read(width);
}

}  // namespace allpairs::scene
