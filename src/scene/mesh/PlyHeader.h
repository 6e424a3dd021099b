// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace allpairs::scene {

enum class PlyType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  std::optional<PlyType> countType;  ///< Of a list: the type of its length.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding : std::uint8_t { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;   ///< In bytes: where the body begins.
  std::size_t lines = 0;  ///< How many lines it has.
  char lineEnd = '\n';    ///< What they end in: '\r' in files of old Macs.
};

/// Bad input: throws FileError with its line.
[[nodiscard]] PlyHeader parsePlyHeader(std::string_view text, const std::filesystem::path& path);

}  // namespace allpairs::scene
