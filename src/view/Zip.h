// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct zip;
struct zip_source;

namespace allpairs::view {

/// A zip archive that is made in memory.
///
/// Bad input: what the library refuses throws Error that names the file in the archive.
class Zip {
 public:
  /// Of files that were made at a moment, such as 2026-01-31T12:00:00Z.
  explicit Zip(const std::string& date);
  ~Zip();
  Zip(const Zip&) = delete;
  Zip& operator=(const Zip&) = delete;

  /// Puts a file in; its bytes are kept until the end.
  void add(const std::string& name, std::string bytes);

  /// The bytes of the archive; nothing may be added afterwards.
  [[nodiscard]] std::string finish();

 private:
  std::uint16_t m_day = 0;  ///< When the files were made, as an archive has it.
  std::uint16_t m_time = 0;
  struct zip* m_archive = nullptr;
  zip_source* m_source = nullptr;
  std::vector<std::unique_ptr<std::string>> m_kept;
};

}  // namespace allpairs::view
