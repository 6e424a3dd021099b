// SPDX-License-Identifier: MIT
#include "mpi/PairFile.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <system_error>
#include <vector>

#include "allpairs/mpi/OnAllRanks.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kShortIds = std::uint64_t{1} << 32;
constexpr std::size_t kBlock = std::size_t{1} << 20;  // pairs that are written at once

/// A file of all ranks beside its place, which is gone unless it was put there.
class SharedFile {
 public:
  SharedFile(MPI_Comm communicator, const fs::path& target) : m_communicator(communicator), m_target(target) {
    MPI_Comm_rank(communicator, &m_rank);
    int process = static_cast<int>(::getpid());  // of rank 0: no other join writes a file of this name
    MPI_Bcast(&process, 1, MPI_INT, 0, communicator);
    m_part = target.string() + '.' + std::to_string(process) + ".part";
    const int mode = MPI_MODE_CREATE | MPI_MODE_WRONLY;
    const int code = MPI_File_open(communicator, m_part.c_str(), mode, MPI_INFO_NULL, &m_file);
    mpi::onAllRanks(communicator, [&] { check(code, "opened"); });
  }

  ~SharedFile() {
    if (m_file != MPI_FILE_NULL) MPI_File_close(&m_file);
    if (m_rank == 0) fs::remove(m_part, m_ignored);
  }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  void write(std::uint64_t position, const void* bytes, std::size_t count) {
    MPI_Status status;
    check(
        MPI_File_write_at(m_file, static_cast<MPI_Offset>(position), bytes, static_cast<int>(count), MPI_BYTE, &status),
        "written");
    int written = 0;  // Open MPI reports success where the disk is full
    check(MPI_Get_count(&status, MPI_BYTE, &written), "written");
    if (static_cast<std::size_t>(written) != count) throw FileError(m_target, "cannot be written: the disk is full");
  }

  void commit() {
    const int synced = MPI_File_sync(m_file);
    const int closed = MPI_File_close(&m_file);
    mpi::onAllRanks(m_communicator, [&] {
      check(synced, "written");
      check(closed, "written");
    });
    mpi::onAllRanks(m_communicator, [&] {
      if (m_rank != 0) return;
      std::error_code problem;
      fs::rename(m_part, m_target, problem);
      if (problem) throw FileError(m_target, "cannot be replaced: " + problem.message());
    });
  }

 private:
  void check(int code, const char* action) const {
    if (code == MPI_SUCCESS) return;
    std::array<char, MPI_MAX_ERROR_STRING> text{};
    int length = 0;
    MPI_Error_string(code, text.data(), &length);
    throw FileError(m_target, std::string("cannot be ") + action + ": " + text.data());
  }

  MPI_Comm m_communicator;
  fs::path m_target;
  std::string m_part;
  MPI_File m_file = MPI_FILE_NULL;
  int m_rank = 0;
  std::error_code m_ignored;
};

template <class Id>
void writeAs(SharedFile& file, std::uint64_t position, std::span<const partition::IdPair> pairs) {
  std::vector<std::array<Id, 2>> block;
  for (std::size_t begin = 0; begin < pairs.size(); begin += kBlock) {
    block.clear();
    for (const auto& pair : pairs.subspan(begin, std::min(kBlock, pairs.size() - begin))) {
      block.push_back({static_cast<Id>(pair.first), static_cast<Id>(pair.second)});
    }
    file.write(position, block.data(), block.size() * sizeof(block.front()));
    position += block.size() * sizeof(block.front());
  }
}

}  // namespace

std::uint64_t writePairs(MPI_Comm communicator, const fs::path& path, std::span<const partition::IdPair> pairs,
                         std::uint64_t boxes) {
  const bool isShort = boxes <= kShortIds;
  std::uint64_t end = pairs.size();
  MPI_Scan(MPI_IN_PLACE, &end, 1, MPI_UINT64_T, MPI_SUM, communicator);
  const std::uint64_t begin = end - pairs.size();
  std::uint64_t all = pairs.size();
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_UINT64_T, MPI_SUM, communicator);
  SharedFile file(communicator, path);
  mpi::onAllRanks(communicator, [&] {
    const std::string order = std::endian::native == std::endian::little ? "<" : ">";
    const std::string header = scene::npyHeader(order + (isShort ? "u4" : "u8"), std::array<std::uint64_t, 2>{all, 2});
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    if (rank == 0) file.write(0, header.data(), header.size());
    if (isShort) {
      writeAs<std::uint32_t>(file, header.size() + 8 * begin, pairs);
    } else {
      writeAs<std::uint64_t>(file, header.size() + 16 * begin, pairs);
    }
  });
  file.commit();
  return all;
}

}  // namespace allpairs::app
