// SPDX-License-Identifier: MIT
#include "scene/sofa/FileFinder.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "allpairs/Error.h"

namespace allpairs::scene::sofa {
namespace {

bool isFile(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

}  // namespace

std::optional<std::filesystem::path> FileFinder::find(const std::string& name,
                                                      const std::filesystem::path& namedIn) const {
  std::string portable = name;
  std::ranges::replace(portable, '\\', '/');
  const std::filesystem::path wanted{portable};
  if (wanted.empty()) return std::nullopt;
  if (wanted.is_absolute()) return isFile(wanted) ? std::optional{wanted} : std::nullopt;
  if (auto beside = namedIn.parent_path() / wanted; isFile(beside)) return beside;
  for (const auto& root : m_roots)
    if (auto below = root / wanted; isFile(below)) return below;
  return std::nullopt;
}

std::string readWholeFile(const std::filesystem::path& path) {
  if (std::error_code ignored; !std::filesystem::exists(path, ignored)) throw FileError(path, "there is no such file");
  if (!isFile(path)) throw FileError(path, "this is not a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path, "cannot be opened for reading");
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw FileError(path, "cannot be read to its end");
  return bytes;
}

}  // namespace allpairs::scene::sofa
