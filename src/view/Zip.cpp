// SPDX-License-Identifier: MIT
#include "Zip.h"

#include <zip.h>

#include <utility>

#include "allpairs/Error.h"

namespace allpairs::view {

Zip::Zip() {
  m_source = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  if (m_source == nullptr) throw Error("cannot make a zip archive in memory");
  zip_source_keep(m_source);
  m_archive = zip_open_from_source(m_source, ZIP_TRUNCATE, nullptr);
  if (m_archive != nullptr) return;
  zip_source_free(m_source);
  zip_source_free(m_source);
  throw Error("cannot make a zip archive in memory");
}

Zip::~Zip() {
  if (m_archive != nullptr) zip_discard(m_archive);
  zip_source_free(m_source);
}

void Zip::add(const std::string& name, std::string bytes) {
  m_kept.push_back(std::make_unique<std::string>(std::move(bytes)));
  zip_source* content = zip_source_buffer(m_archive, m_kept.back()->data(), m_kept.back()->size(), 0);
  const zip_int64_t index = content == nullptr ? -1 : zip_file_add(m_archive, name.c_str(), content, ZIP_FL_ENC_UTF_8);
  if (index >= 0) return;
  zip_source_free(content);
  throw Error("cannot put " + name + " into the archive: " + zip_strerror(m_archive));
}

std::string Zip::finish() {
  if (zip_close(m_archive) != 0) throw Error(std::string("cannot finish the archive: ") + zip_strerror(m_archive));
  m_archive = nullptr;
  if (zip_source_open(m_source) != 0) throw Error("cannot read the archive back");
  zip_stat_t status{};
  std::string result;
  if (zip_source_stat(m_source, &status) == 0) {
    result.resize(status.size);
    result.resize(static_cast<std::size_t>(zip_source_read(m_source, result.data(), result.size())));
  }
  zip_source_close(m_source);
  return result;
}

}  // namespace allpairs::view
