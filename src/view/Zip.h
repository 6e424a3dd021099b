// SPDX-License-Identifier: MIT
#pragma once

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
  Zip();
  ~Zip();
  Zip(const Zip&) = delete;
  Zip& operator=(const Zip&) = delete;

  /// Puts a file in; its bytes are kept until the end.
  void add(const std::string& name, std::string bytes);

  /// The bytes of the archive; nothing may be added afterwards.
  [[nodiscard]] std::string finish();

 private:
  struct zip* m_archive = nullptr;
  zip_source* m_source = nullptr;
  std::vector<std::unique_ptr<std::string>> m_kept;
};

}  // namespace allpairs::view
