// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "allpairs/StopFlag.h"

namespace allpairs::scene {

/// A file that is read from front to back, or from where seek() goes, and says with FileError what went wrong.
class InputFile {
 public:
  /// Reading throws Stopped soon after a flag that is given is set.
  ///
  /// Bad input: a file that is missing, a folder, or unreadable throws FileError.
  explicit InputFile(const std::filesystem::path& path, const StopFlag* stop = nullptr);

  /// How many bytes are left to read.
  [[nodiscard]] std::uint64_t remaining() const noexcept { return m_remaining; }

  /// How many bytes lie before the next that is read.
  [[nodiscard]] std::uint64_t position() const noexcept { return m_size - m_remaining; }

  /// Goes on at `position`, which is within the file.
  void seek(std::uint64_t position);

  /// Reads exactly `count` bytes; fewer in the file throw FileError.
  void read(void* target, std::size_t count);

 private:
  void refusePointer();
  void readPiece(char* target, std::size_t count);

  std::filesystem::path m_path;
  const StopFlag* m_stop;
  std::ifstream m_stream;
  std::uint64_t m_size = 0;
  std::uint64_t m_remaining = 0;
};

/// Throws FileError unless the path is a file that can be opened.
void requireFile(const std::filesystem::path& path);

/// The whole file as text.
[[nodiscard]] std::string readText(const std::filesystem::path& path, const StopFlag* stop = nullptr);

/// Whether what stands behind the end that a file's header promises fills it up, and holds nothing: zeros, blanks and
/// ends of lines.
[[nodiscard]] bool isFilling(std::string_view rest);

/// Throws FileError where it is more.
void requireFilling(std::string_view rest, const std::filesystem::path& path);

/// Takes off the mark with which some programs begin a text in UTF-8.
void removeByteOrderMark(std::string& text);

/// Throws where a mark says that a text is in UTF-16, as Windows PowerShell writes what a program prints into a file.
void refuseUtf16(std::string_view text, const std::filesystem::path& path);

/// Takes off that of UTF-8 likewise, and ends the lines of a text in \n that end in \r alone, be it all of them or some.
void makeLines(std::string& text);

/// The extension in lower case, with its dot: ".npy".
[[nodiscard]] std::string lowerExtension(const std::filesystem::path& path);

}  // namespace allpairs::scene
