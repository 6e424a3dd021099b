// SPDX-License-Identifier: MIT
#include "mpi/PairFile.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "allpairs/mpi/OnAllRanks.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/TargetFile.h"
#include "allpairs/scene/WriteResult.h"
#include "cli/TargetFile.h"

namespace allpairs::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kShortIds = std::uint64_t{1} << 32;
constexpr std::size_t kBlock = std::size_t{1} << 20;  // pairs that are written at once

/// The file to replace: what a link leads to.
fs::path checkedTarget(const fs::path& target) {
  std::error_code problem;
  const fs::file_status status = fs::status(target, problem);
  if (fs::is_directory(status)) throw FileError(target, "is a folder; -o takes a file");
  if (fs::exists(status) && !fs::is_regular_file(status)) throw FileError(target, "is no file that can be replaced");
  return scene::resolvedTarget(target);
}

}  // namespace

PairFile::PairFile(MPI_Comm communicator, const fs::path& target) : m_communicator(communicator), m_given(target) {
  MPI_Comm_rank(communicator, &m_rank);
  try {
    mpi::onAllRanks(communicator, [this] {
      if (m_rank == 0) create();
    });
    shareName();
  } catch (...) {
    close();
    throw;
  }
}

PairFile::~PairFile() { close(); }

void PairFile::close() {
  if (m_descriptor >= 0) ::close(m_descriptor);
  if (m_rank == 0 && !m_part.empty()) ::unlink(m_part.c_str());
  m_descriptor = -1;
  m_part.clear();
}

/// A new file of a name that nobody has, short whatever the target's is.
void PairFile::create() {
  m_target = checkedTarget(m_given);
  m_part = (m_target.parent_path() / ".allpairs-mpi-XXXXXX").string();
  m_descriptor = ::mkostemp(m_part.data(), O_CLOEXEC);
  if (m_descriptor < 0) {
    const int problem = errno;
    m_part.clear();
    fail("created", problem);
  }
}

/// The other ranks open what rank 0 has made.
void PairFile::shareName() {
  int size = static_cast<int>(m_part.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, m_communicator);
  mpi::onAllRanks(m_communicator, [this, size] { m_part.resize(static_cast<std::size_t>(size)); });
  MPI_Bcast(m_part.data(), size, MPI_CHAR, 0, m_communicator);
  mpi::onAllRanks(m_communicator, [this] {
    if (m_rank == 0) return;
    m_descriptor = ::open(m_part.c_str(), O_WRONLY | O_CLOEXEC);
    if (m_descriptor < 0) fail("opened by every rank", errno);
  });
}

std::uint64_t PairFile::write(std::span<const partition::IdPair> pairs, std::uint64_t boxes) {
  const bool isShort = boxes <= kShortIds;
  std::uint64_t end = pairs.size();
  MPI_Scan(MPI_IN_PLACE, &end, 1, MPI_UINT64_T, MPI_SUM, m_communicator);
  std::uint64_t all = pairs.size();
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_UINT64_T, MPI_SUM, m_communicator);
  const std::uint64_t begin = end - pairs.size();
  mpi::onAllRanks(m_communicator, [&] {
    const std::string order = std::endian::native == std::endian::little ? "<" : ">";
    const std::string header = scene::npyHeader(order + (isShort ? "u4" : "u8"), std::array<std::uint64_t, 2>{all, 2});
    if (m_rank == 0) writeAt(0, header.data(), header.size());
    if (isShort) {
      writeAs<std::uint32_t>(header.size() + 8 * begin, pairs);
    } else {
      writeAs<std::uint64_t>(header.size() + 16 * begin, pairs);
    }
    // Not before all ranks have opened it for writing, which the target's mode may forbid.
    if (m_rank == 0 && ::fchmod(m_descriptor, modeOfTarget(m_target)) != 0) fail("replaced", errno);
    if (::fsync(m_descriptor) != 0) fail("written", errno);
    const int descriptor = m_descriptor;
    m_descriptor = -1;
    if (::close(descriptor) != 0) fail("written", errno);  // network file systems may only say it now
  });
  mpi::onAllRanks(m_communicator, [this] {
    if (m_rank == 0 && ::rename(m_part.c_str(), m_target.c_str()) != 0) fail("replaced", errno);
  });
  m_part.clear();
  return all;
}

template <class Id>
void PairFile::writeAs(std::uint64_t position, std::span<const partition::IdPair> pairs) {
  std::vector<std::array<Id, 2>> block;
  for (std::size_t begin = 0; begin < pairs.size(); begin += kBlock) {
    block.clear();
    for (const auto& pair : pairs.subspan(begin, std::min(kBlock, pairs.size() - begin))) {
      block.push_back({static_cast<Id>(pair.first), static_cast<Id>(pair.second)});
    }
    writeAt(position, block.data(), block.size() * sizeof(block.front()));
    position += block.size() * sizeof(block.front());
  }
}

void PairFile::writeAt(std::uint64_t position, const void* bytes, std::size_t count) {
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(m_descriptor, from, count, static_cast<off_t>(position));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("written", written == 0 ? ENOSPC : errno);
    from += written;
    count -= static_cast<std::size_t>(written);
    position += static_cast<std::uint64_t>(written);
  }
}

void PairFile::fail(const char* action, int problem) const {
  throw FileError::ofSystem(m_given, std::string("cannot be ") + action, {problem, std::generic_category()});
}

}  // namespace allpairs::app
