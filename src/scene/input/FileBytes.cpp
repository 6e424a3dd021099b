// SPDX-License-Identifier: MIT
#include "input/FileBytes.h"

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "allpairs/StopFlag.h"
#include "allpairs/scene/FileError.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

/// Some ten milliseconds, of which most is memory that is touched for the first time.
constexpr std::size_t kReadAtOnce = std::size_t{16} << 20;

/// What a clone without Git LFS has in place of a large file: so much text, and no more than that.
constexpr std::string_view kPointer = "version https://git-lfs.github.com/spec/v1\n";
constexpr std::uint64_t kMostOfPointer = 1024;

/// Fails for what the system has said last.
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& action) {
  const std::error_code code(errno, std::generic_category());
  throw FileError::ofSystem(path, "cannot be " + action, code);
}

}  // namespace

void requireFile(const std::filesystem::path& path) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (status.type() == std::filesystem::file_type::not_found) {
    const bool isLink = std::filesystem::is_symlink(std::filesystem::symlink_status(path, problem));
    throw FileError(path, isLink ? "is a link that leads nowhere" : "no such file or folder",
                    std::make_error_code(std::errc::no_such_file_or_directory));
  }
  if (problem == std::errc::too_many_symbolic_link_levels)
    throw FileError(path, "is a link that leads nowhere", problem);
  if (problem) throw FileError(path, problem.message(), problem);
  if (std::filesystem::is_directory(status)) {
    throw FileError(path, "is a folder, not a file", std::make_error_code(std::errc::is_a_directory));
  }
  if (!std::filesystem::is_regular_file(status)) throw FileError(path, "is not a regular file");  // a pipe would wait
  errno = 0;
  if (!std::ifstream(path, std::ios::binary)) fail(path, "opened");
}

InputFile::InputFile(const std::filesystem::path& path, const StopFlag* stop) : m_path(path), m_stop(stop) {
  requireFile(path);
  m_stream.open(path, std::ios::binary);
  m_stream.seekg(0, std::ios::end);
  const auto size = static_cast<std::streamoff>(m_stream.tellg());
  m_stream.seekg(0);
  if (!m_stream || size < 0) throw FileError(path, "is not a regular file");
  m_size = static_cast<std::uint64_t>(size);
  m_remaining = m_size;
  if (m_size < kMostOfPointer && m_size >= kPointer.size()) refusePointer();
}

void InputFile::refusePointer() {
  std::string begin(kPointer.size(), '\0');
  read(begin.data(), begin.size());
  if (begin == kPointer)
    throw FileError(m_path, "is a Git LFS pointer, not the file: 'git lfs pull' in its folder gets it");
  seek(0);
}

void InputFile::seek(std::uint64_t position) {
  m_stream.seekg(static_cast<std::streamoff>(position));
  m_remaining = m_size - position;
}

void InputFile::read(void* target, std::size_t count) {
  if (count > m_remaining) throw FileError(m_path, "ends too early");
  for (std::size_t done = 0; done < count; done += kReadAtOnce) {
    readPiece(static_cast<char*>(target) + done, std::min(kReadAtOnce, count - done));
  }
}

void InputFile::readPiece(char* target, std::size_t count) {
  checkStop(m_stop);
  errno = 0;
  m_stream.read(target, static_cast<std::streamsize>(count));
  if (!m_stream && errno == 0) throw FileError(m_path, "ends too early");
  if (!m_stream) fail(m_path, "read");
  m_remaining -= count;
}

std::string readText(const std::filesystem::path& path, const StopFlag* stop) {
  InputFile file(path, stop);
  std::string text(static_cast<std::size_t>(file.remaining()), '\0');
  file.read(text.data(), text.size());
  return text;
}

bool isFilling(std::string_view rest) {
  return std::all_of(rest.begin(), rest.end(), [](char c) { return c == '\0' || isBlankOrLineEnd(c); });
}

void requireFilling(std::string_view rest, const std::filesystem::path& path) {
  if (!isFilling(rest))
    throw FileError(path, "has " + std::to_string(rest.size()) + " bytes behind what its header promises");
}

void removeByteOrderMark(std::string& text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.erase(0, kMark.size());
}

void refuseUtf16(std::string_view text, const std::filesystem::path& path) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw FileError(path, "is a text in UTF-16; UTF-8 can be read");
}

void makeLines(std::string& text) {
  removeByteOrderMark(text);
  for (std::size_t at = text.find('\r'); at != std::string::npos; at = text.find('\r', at)) {
    const std::size_t next = std::min(text.find_first_not_of('\r', at), text.size());
    if (next == text.size() || text[next] != '\n')
      std::fill(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(next), '\n');
    at = next;
  }
}

std::string lowerExtension(const std::filesystem::path& path) { return lowerCase(path.extension().string()); }

}  // namespace allpairs::scene
