// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "support/TempFolder.h"

namespace allpairs::fuzz {

/// The files of a folder by name; none where the folder is absent.
inline std::vector<std::filesystem::path> filesOf(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Runs a target on the inputs that the project keeps for it, and names each on stderr before it runs.
inline void replay(const std::string& target, void (*run)(std::span<const std::uint8_t>)) {
  const std::filesystem::path root = ALLPAIRS_FUZZ_DIR;
  std::vector<std::filesystem::path> inputs = filesOf(root / "corpus" / target);
  ASSERT_FALSE(inputs.empty()) << "no corpus in " << root / "corpus" / target;
  for (std::filesystem::path& found : filesOf(root / "regressions" / target)) inputs.push_back(std::move(found));
  for (const std::filesystem::path& input : inputs) {
    std::cerr << "replaying " << input << '\n';
    const std::string bytes = test::readBytes(input);
    run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  }
}

}  // namespace allpairs::fuzz
