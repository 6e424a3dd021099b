// SPDX-License-Identifier: MIT
#include "Zip.h"

#include <zip.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <utility>

#include "allpairs/Error.h"

namespace allpairs::view {

namespace {

/// A number of a date, at a place of its text; 0 where there is none.
unsigned numberAt(const std::string& date, std::size_t place, std::size_t digits) {
  unsigned number = 0;
  if (date.size() >= place + digits) std::from_chars(date.data() + place, date.data() + place + digits, number);
  return number;
}

}  // namespace

Zip::Zip(const std::string& date) {
  constexpr unsigned kFirstYear = 1980;
  constexpr std::uint16_t kFirstDay = 1U << 5 | 1U;
  constexpr unsigned kLastYear = 2107;
  if (const unsigned year = std::min(numberAt(date, 0, 4), kLastYear); year >= kFirstYear) {
    m_day = static_cast<std::uint16_t>((year - kFirstYear) << 9 | numberAt(date, 5, 2) << 5 | numberAt(date, 8, 2));
    m_time = static_cast<std::uint16_t>(numberAt(date, 11, 2) << 11 | numberAt(date, 14, 2) << 5 |
                                        numberAt(date, 17, 2) / 2);
  } else {
    m_day = kFirstDay;
  }
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
  if (index >= 0) {
    zip_file_set_dostime(m_archive, static_cast<zip_uint64_t>(index), m_time, m_day, 0);
    return;
  }
  zip_source_free(content);
  throw Error("cannot put " + name + " into the archive: " + zip_strerror(m_archive));
}

std::string Zip::finish() {
  if (zip_close(m_archive) != 0) throw Error(std::string("cannot finish the archive: ") + zip_strerror(m_archive));
  m_archive = nullptr;
  if (zip_source_open(m_source) != 0) throw Error("cannot read the archive back");
  zip_stat_t status{};
  std::string result;
  if (zip_source_stat(m_source, &status) == 0) result.resize(status.size);
  const zip_int64_t read = zip_source_read(m_source, result.data(), result.size());
  zip_source_close(m_source);
  if (read <= 0 || static_cast<std::size_t>(read) != result.size()) throw Error("cannot read the archive back");
  return result;
}

}  // namespace allpairs::view
