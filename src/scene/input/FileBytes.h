// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace allpairs::scene {

/// A file that is read from front to back and says with FileError what went wrong.
class InputFile {
 public:
  /// Bad input: a file that is missing, a folder, or unreadable throws FileError.
  explicit InputFile(const std::filesystem::path& path);

  /// How many bytes are left to read.
  [[nodiscard]] std::uint64_t remaining() const noexcept { return m_remaining; }

  /// Reads exactly `count` bytes; fewer in the file throw FileError.
  void read(void* target, std::size_t count);

 private:
  std::filesystem::path m_path;
  std::ifstream m_stream;
  std::uint64_t m_remaining = 0;
};

/// Throws FileError unless the path is a file that can be opened.
void requireFile(const std::filesystem::path& path);

/// The whole file as text.
[[nodiscard]] std::string readText(const std::filesystem::path& path);

/// The extension in lower case, with its dot: ".npy".
[[nodiscard]] std::string lowerExtension(const std::filesystem::path& path);

}  // namespace allpairs::scene
