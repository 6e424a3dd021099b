// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "Provenance.h"
#include "Samples.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::bench {

/// What one contender took for one task.
struct TaskRecord {
  std::string task;     ///< What was done, such as a list of candidates or a kind of query.
  std::string subject;  ///< On what.
  std::size_t size = 0;
  std::string contender;
  std::string setting;
  std::size_t results = 0;
  std::vector<double> cpuMs;  ///< Of each repetition.
  bool right = true;          ///< Whether its results were those of the others.
};

/// A file of CSV with a line for each record; without a name, none is written. Read by bench/report.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path) : m_path(path) {
    if (path.empty()) return;
    m_file.open(path);
    if (!m_file) throw FileError(path, "can't be written");
    m_file << "task,subject,size,contender,setting,results,repetitions,median_cpu_ms,least_cpu_ms,most_cpu_ms,right,"
              "commit,compiler,processor,date\n";
  }

  void add(const TaskRecord& record) {
    if (!m_file.is_open()) return;
    const auto [least, most] = std::minmax_element(record.cpuMs.begin(), record.cpuMs.end());
    m_file << record.task << ',' << record.subject << ',' << record.size << ",\"" << record.contender << "\",\""
           << record.setting << "\"," << record.results << ',' << record.cpuMs.size() << ','
           << measure::median(record.cpuMs) << ',' << *least << ',' << *most << ',' << (record.right ? "yes" : "no")
           << ',' << m_provenance.commit << ",\"" << m_provenance.compiler << "\",\"" << m_provenance.processor << "\","
           << m_provenance.date << '\n'
           << std::flush;
    if (!m_file) throw FileError(m_path, "can't be written");
  }

 private:
  std::string m_path;
  measure::Provenance m_provenance = measure::provenance();
  std::ofstream m_file;
};

}  // namespace allpairs::bench
