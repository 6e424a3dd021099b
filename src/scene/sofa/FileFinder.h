// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace allpairs::scene::sofa {

/// Finds the files that a scene names: in the folder of the file that names them, then below the search roots.
class FileFinder {
 public:
  explicit FileFinder(std::vector<std::filesystem::path> roots) : m_roots(std::move(roots)) {}

  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& name,
                                                          const std::filesystem::path& namedIn) const;

 private:
  std::vector<std::filesystem::path> m_roots;
};

/// The bytes of a file; throws FileError.
[[nodiscard]] std::string readWholeFile(const std::filesystem::path& path);

}  // namespace allpairs::scene::sofa
