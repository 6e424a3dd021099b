// SPDX-License-Identifier: MIT
#include "Memory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <span>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#if defined(__SANITIZE_ADDRESS__)
#define ALLPAIRS_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ALLPAIRS_ADDRESS_SANITIZER
#endif
#endif

namespace allpairs::engine {
namespace {

constexpr std::size_t kAlignment = 64;

/// What a block has at least, to be one.
constexpr std::size_t kSmallBlock = std::size_t{1} << 13;

std::size_t roundUp(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

#if defined(__linux__)

constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Blocks from this size on are mapped. An address sanitizer does not see the end of a mapped block.
#if defined(ALLPAIRS_ADDRESS_SANITIZER)
constexpr std::size_t kSmallestMapped = std::size_t{1} << 20;
#else
constexpr std::size_t kSmallestMapped = kSmallBlock;
#endif

/// Up to here in sizes that are powers of two.
constexpr std::size_t kLargestPower = std::size_t{1} << 26;

/// What is kept of freed blocks for all threads together.
constexpr std::size_t kMostShared = std::size_t{1} << 28;

bool isMapped(std::size_t bytes) { return bytes >= kSmallestMapped; }

/// What is mapped for so many bytes. Of a large block only the pages that are used take memory.
std::size_t mappedSize(std::size_t bytes) {
  return bytes <= kLargestPower ? std::bit_ceil(bytes) : roundUp(bytes, kLargePage);
}

/// A block that nobody uses.
struct SpareBlock {
  void* memory = nullptr;
  std::size_t size = 0;
  std::uint64_t came = 0;  ///< When it came among those that all threads share.
};

/// The system may take the pages back when it needs memory; until then they are as they were. No more than advice.
void lend([[maybe_unused]] SpareBlock block) {
#if defined(MADV_FREE)
  static_cast<void>(madvise(block.memory, block.size, MADV_FREE));
#endif
}

/// Blocks that have been freed, kept with their pages for the next who needs one of that size: a search that is made, used
/// and thrown away would otherwise spend up to a third of its time on page faults.
template <std::size_t kCapacity>
class SpareBlocks {
 public:
  /// The block of that size that came last, or null.
  void* take(std::size_t size) {
    for (std::size_t i = m_count; i-- > 0;) {
      if (m_blocks[i].size == size) return takeAt(i).memory;
    }
    return nullptr;
  }

  /// Keeps the block; returns false where there are `mostEqual` of its size, or `mostBytes` of all.
  bool keep(SpareBlock spare, std::size_t mostEqual, std::size_t mostBytes) {
    if (m_count == kCapacity || m_bytes + spare.size > mostBytes) return false;
    const auto isEqual = [&](const SpareBlock& block) { return block.size == spare.size; };
    if (std::cmp_greater_equal(std::ranges::count_if(blocks(), isEqual), mostEqual)) return false;
    m_blocks[m_count++] = spare;
    m_bytes += spare.size;
    return true;
  }

  /// In the order in which they came.
  [[nodiscard]] std::span<const SpareBlock> blocks() const noexcept { return std::span(m_blocks).first(m_count); }

  [[nodiscard]] std::size_t bytes() const noexcept { return m_bytes; }

  SpareBlock takeAt(std::size_t index) {
    const SpareBlock taken = m_blocks[index];
    std::copy(m_blocks.begin() + index + 1, m_blocks.begin() + m_count, m_blocks.begin() + index);
    --m_count;
    m_bytes -= taken.size;
    return taken;
  }

 private:
  std::array<SpareBlock, kCapacity> m_blocks;
  std::size_t m_count = 0;
  std::size_t m_bytes = 0;
};

void unmap(SpareBlock block) { munmap(block.memory, block.size); }

/// What all threads share: what one of them maps, another one may free. Whoever finds it in use goes without, so that nobody
/// waits, not even the child of a process that was forked meanwhile.
class SharedBlocks {
 public:
  void* take(std::size_t size) {
    const std::unique_lock lock(m_mutex, std::try_to_lock);
    return lock.owns_lock() ? m_spare.take(size) : nullptr;
  }

  /// Gives the block back to the system where it can't be kept.
  void give(SpareBlock block) {
    if (!keep(block)) unmap(block);
  }

 private:
  static constexpr std::size_t kCapacity = 64;

  /// A block that nobody has asked for while so many bytes came makes room: it was left by a search of another size. A
  /// younger one stays, since a search that needs more than is kept would find nothing of what it freed the last time.
  static constexpr std::uint64_t kOld = 2 * kMostShared;

  /// So much is kept without a word to the system, which would have to tell every processor at each block.
  static constexpr std::size_t kMostHeld = std::size_t{1} << 26;
  static constexpr std::size_t kAlwaysLent = std::size_t{1} << 24;

  /// What a small block counts as, so that small ones make room as well.
  static constexpr std::size_t kLeastCounted = kOld / 256;

  bool keep(SpareBlock block) {
    const std::unique_lock lock(m_mutex, std::try_to_lock);
    if (!lock.owns_lock() || block.size > kMostShared) return false;
    m_given += std::max(block.size, kLeastCounted);
    block.came = m_given;
    while (!m_spare.keep(block, kCapacity, kMostShared)) {
      if (m_spare.blocks().front().came + kOld > m_given) return false;
      unmap(m_spare.takeAt(0));
    }
    if (block.size >= kAlwaysLent || m_spare.bytes() > kMostHeld) lend(block);
    return true;
  }

  std::mutex m_mutex;
  SpareBlocks<kCapacity> m_spare;
  std::uint64_t m_given = 0;
};

/// Never destroyed: threads may end after everything else has.
SharedBlocks& sharedBlocks() {
  static auto& blocks = *new SharedBlocks;
  return blocks;
}

/// What a thread keeps for itself: small blocks, and few of a size.
class OwnBlocks {
 public:
  OwnBlocks() = default;
  OwnBlocks(const OwnBlocks&) = delete;
  OwnBlocks& operator=(const OwnBlocks&) = delete;
  ~OwnBlocks() {
    for (const SpareBlock& block : m_spare.blocks()) sharedBlocks().give(block);
  }

  void* take(std::size_t size) { return size <= kLargestOwn ? m_spare.take(size) : nullptr; }
  bool keep(SpareBlock block) { return block.size <= kLargestOwn && m_spare.keep(block, kMostEqual, kMostOwn); }

 private:
  static constexpr std::size_t kLargestOwn = std::size_t{1} << 20;
  static constexpr std::size_t kMostOwn = std::size_t{4} << 20;
  static constexpr std::size_t kMostEqual = 4;

  SpareBlocks<24> m_spare;
};

OwnBlocks& ownBlocks() {
  thread_local OwnBlocks blocks;
  return blocks;
}

/// Touches the first pages of a block all at once, where the system can: one by one they take twice the time. No more
/// than advice.
void touchPages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_POPULATE_WRITE)
  constexpr std::size_t kPage = 4096;
  static_cast<void>(madvise(memory, roundUp(bytes, kPage), MADV_POPULATE_WRITE));
#endif
}

void* map(std::size_t size) {
  void* mapped = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return mapped == MAP_FAILED ? nullptr : mapped;
}

/// Memory that begins at a large page.
void* mapLarge(std::size_t size) {
  void* mapped = map(size + kLargePage);
  if (mapped == nullptr) return nullptr;
  auto* begin = static_cast<char*>(mapped);
  const std::size_t before =
      roundUp(reinterpret_cast<std::uintptr_t>(begin), kLargePage) - reinterpret_cast<std::uintptr_t>(begin);
  if (before != 0) munmap(begin, before);
  if (before != kLargePage) munmap(begin + before + size, kLargePage - before);
  // Advice only: where it is not taken, the memory is as good, only slower to touch for the first time.
  static_cast<void>(madvise(begin + before, size, MADV_HUGEPAGE));
  return begin + before;
}

void* allocateMapped(std::size_t bytes) {
  const std::size_t size = mappedSize(bytes);
  if (void* own = ownBlocks().take(size); own != nullptr) return own;
  if (void* shared = sharedBlocks().take(size); shared != nullptr) return shared;
  if (size >= kLargePage) return mapLarge(size);
  void* memory = map(size);
  if (memory != nullptr) touchPages(memory, bytes);
  return memory;
}

void freeMapped(void* memory, std::size_t bytes) {
  const SpareBlock block{memory, mappedSize(bytes)};
  if (!ownBlocks().keep(block)) sharedBlocks().give(block);
}

/// Moves pages, not contents. What has grown before is made of several mappings, of which each is moved on its own.
// Each call halves the size.
// NOLINTNEXTLINE(misc-no-recursion)
bool movePages(char* from, char* to, std::size_t size) {
  if (mremap(from, size, size, MREMAP_MAYMOVE | MREMAP_FIXED, to) != MAP_FAILED) return true;
  const std::size_t half = roundUp(size / 2, kLargePage);
  if (half == size) return false;
  return movePages(from, to, half) && movePages(from + half, to + half, size - half);
}

void* growMapped(void* memory, std::size_t bytes, std::size_t newBytes) {
  const std::size_t size = mappedSize(bytes);
  if (size == mappedSize(newBytes)) return memory;
  void* larger = allocateMapped(newBytes);
  if (larger == nullptr) return nullptr;
  // From one large page's border to another's, so that they stay large.
  if (size >= kLargePage && movePages(static_cast<char*>(memory), static_cast<char*>(larger), size)) return larger;
  std::memcpy(larger, memory, bytes);
  freeMapped(memory, bytes);
  return larger;
}

#else

bool isMapped(std::size_t) { return false; }
void* allocateMapped(std::size_t) { return nullptr; }
void* growMapped(void*, std::size_t, std::size_t) { return nullptr; }
void freeMapped(void*, std::size_t) {}

#endif

}  // namespace

void* allocateMemory(std::size_t bytes) noexcept {
  return isMapped(bytes) ? allocateMapped(bytes) : std::aligned_alloc(kAlignment, roundUp(bytes, kAlignment));
}

void* growMemory(void* memory, std::size_t bytes, std::size_t newBytes) noexcept {
  if (isMapped(bytes)) return growMapped(memory, bytes, newBytes);
  void* larger = allocateMemory(newBytes);
  if (larger == nullptr) return nullptr;
  std::memcpy(larger, memory, bytes);
  std::free(memory);
  return larger;
}

void freeMemory(void* memory, std::size_t bytes) noexcept {
  isMapped(bytes) ? freeMapped(memory, bytes) : std::free(memory);
}

void* InBlock::operator new(std::size_t size) {
  void* memory = allocateMemory(std::max(size, kSmallBlock));
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void InBlock::operator delete(void* memory, std::size_t size) noexcept {
  freeMemory(memory, std::max(size, kSmallBlock));
}

std::size_t& bufferAllocations() noexcept {
  thread_local std::size_t count = 0;
  return count;
}

std::size_t& bufferBytes() noexcept {
  thread_local std::size_t bytes = 0;
  return bytes;
}

}  // namespace allpairs::engine
