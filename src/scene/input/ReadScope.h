// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/StopFlag.h"
#include "allpairs/scene/ReadOptions.h"

namespace allpairs::scene {

/// What reading one input may touch: the files that it may name, and the memory that it may take; and whether it is to
/// go on.
///
/// Files:  regular ones in the input's own folder, in the search roots, and below these, symbolic links resolved; all
///         where ReadOptions::allowOutside is set.
/// Memory: ReadOptions::maxMemory, or where that is 0 the less of half of the machine's memory and of kFreeBytes plus
///         kBytesPerByte for each byte of the files that were read.
class ReadScope {
 public:
  static constexpr std::uint64_t kFreeBytes = 256ULL << 20;  ///< For what a file describes without writing it out.
  static constexpr std::uint64_t kBytesPerByte = 256;        ///< More than any honest object takes that a file lists.
  static constexpr std::uint64_t kPairsPerByte = 32;         ///< For 256 MiB they take half a minute.
  static constexpr std::uint64_t kBytesPerModel = 1000;      ///< In memory, besides its elements and names.

  ReadScope(const std::filesystem::path& input, const ReadOptions& options);

  /// Why a file may not be read, as a message ends.
  static constexpr const char* kOutside =
      "lies outside of the input's folder and of those given with --data; --allow-outside allows it";

  /// A file that was found, or else why it was not: "is nowhere to be found; ...".
  struct Found {
    std::filesystem::path path;
    std::string problem;  ///< Empty where the file was found.
  };

  /// Finds the file that another names: in that one's folder, else below the search roots in their order. Nothing is
  /// asked of a file outside, not even whether it exists.
  [[nodiscard]] Found find(std::string_view name, const std::filesystem::path& namedIn) const;

  /// Whether a file may be read.
  [[nodiscard]] bool allows(const std::filesystem::path& file) const;

  /// Counts a file that is about to be read: what may be taken grows with it, once however often it is read.
  ///
  /// Bad input: throws FileError if the file alone is larger than what may be taken.
  void admit(const std::filesystem::path& file);

  /// Counts memory that is about to be taken. Nothing is counted back: this bounds the work, too.
  ///
  /// Bad input: throws FileError if it is too much.
  void take(std::uint64_t bytes) {
    checkStop();
    m_taken = bytes > UINT64_MAX - m_taken ? UINT64_MAX : m_taken + bytes;
    if (m_taken > m_limit) refuse();
  }

  /// Counts pairs of what is about to be compared, of which a few words may ask for many; returns false if that takes too
  /// long: more than kPairsPerByte for each byte that may be taken.
  [[nodiscard]] bool takeWork(std::uint64_t pairs) noexcept {
    m_pairs = pairs > UINT64_MAX - m_pairs ? UINT64_MAX : m_pairs + pairs;
    return m_pairs / kPairsPerByte <= m_limit;
  }

  /// For a list of such elements that grows one by one: old and new memory are held while it moves.
  void takeElements(std::uint64_t count, std::size_t size) {
    constexpr std::uint64_t kGrowth = 3;
    take(count > UINT64_MAX / (kGrowth * size) ? UINT64_MAX : kGrowth * size * count);
  }

  /// Throws Stopped if ReadOptions::stop is set.
  void checkStop() const { allpairs::checkStop(m_stop); }

  /// All files that were read.
  [[nodiscard]] std::vector<std::filesystem::path> files() const { return {m_files.begin(), m_files.end()}; }

  [[nodiscard]] const StopFlag* stop() const noexcept { return m_stop; }

  /// How much is left of what may be taken.
  [[nodiscard]] std::uint64_t left() const noexcept { return m_taken < m_limit ? m_limit - m_taken : 0; }

 private:
  [[noreturn]] void refuse() const;
  [[nodiscard]] std::uint64_t limit() const;

  std::filesystem::path m_input;
  std::vector<std::filesystem::path> m_searchRoots;
  std::vector<std::filesystem::path> m_folders;  ///< In which files may be, canonical.
  bool m_allowOutside;
  std::uint64_t m_maxMemory;
  const StopFlag* m_stop;
  std::set<std::filesystem::path> m_files;  ///< That were counted.
  std::uint64_t m_bytes = 0;                ///< Of these files.
  std::uint64_t m_taken = 0;
  std::uint64_t m_limit = 0;
  std::uint64_t m_pairs = 0;  ///< Of what was compared.
};

}  // namespace allpairs::scene
