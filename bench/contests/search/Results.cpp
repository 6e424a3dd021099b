// SPDX-License-Identifier: MIT
#include "Results.h"

#include <sstream>
#include <utility>

#include "allpairs/scene/FileError.h"

namespace allpairs::bench {

namespace {

constexpr const char* kColumns =
    "name,setting,part,scene,n,threads,pairs,hash,median_ms,median_cpu_ms,min_ms,max_ms,repetitions,mistake,"
    "commit,compiler,build,processor,processors,instruction_set,date\n";

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string lineOf(const Cell& cell, const Contender& contender, const Outcome& outcome) {
  const measure::Summary& times = outcome.times;
  std::ostringstream line;
  line << quoted(contender.name) << ',' << quoted(contender.setting) << ',' << cell.part << ',' << sceneName(cell)
       << ',' << cell.boxes << ',' << contender.threads << ',' << outcome.pairs << ',' << outcome.hash << ','
       << times.medianMs << ',' << times.medianCpuMs << ',' << times.minMs << ',' << times.maxMs << ','
       << times.repetitions << ',' << quoted(outcome.mistake);
  return line.str();
}

std::string lineOf(const measure::Provenance& p, const std::string& instructionSet) {
  std::ostringstream line;
  line << p.commit << ',' << quoted(p.compiler) << ',' << p.buildType << ',' << quoted(p.processor) << ','
       << p.processors << ',' << instructionSet << ',' << p.date;
  return line.str();
}

}  // namespace

std::string sceneName(const Cell& cell) { return cell.scene + (cell.sorted ? "-sorted" : ""); }

Results::Results(const std::filesystem::path& path, std::string instructionSet)
    : m_path(path), m_file(path), m_provenance(measure::provenance()), m_instructionSet(std::move(instructionSet)) {
  m_file << kColumns << std::flush;
  if (!m_file) throw FileError(path, "can't be written");
}

void Results::add(const Cell& cell, const std::vector<Contender>& contenders, const std::vector<Outcome>& outcomes) {
  for (std::size_t k = 0; k < contenders.size(); ++k) {
    m_file << lineOf(cell, contenders[k], outcomes[k]) << ',' << lineOf(m_provenance, m_instructionSet) << '\n';
  }
  m_file.flush();
  if (!m_file) throw FileError(m_path, "can't be written");
}

}  // namespace allpairs::bench
