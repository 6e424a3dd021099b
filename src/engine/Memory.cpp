// SPDX-License-Identifier: MIT
#include "Memory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
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

/// What a thread keeps of freed blocks, in all.
constexpr std::size_t kMostKept = std::size_t{1} << 28;

bool isMapped(std::size_t bytes) { return bytes >= kSmallestMapped; }

/// What is mapped for so many bytes. Of a large block only the pages that are used take memory.
std::size_t mappedSize(std::size_t bytes) {
  return bytes <= kLargestPower ? std::bit_ceil(bytes) : roundUp(bytes, kLargePage);
}

/// The system may take the pages back when it needs memory; until then they are as they were. No more than advice.
void lend([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t size) {
#if defined(MADV_FREE)
  static_cast<void>(madvise(memory, size, MADV_FREE));
#endif
}

/// Blocks that have been freed, kept with their pages for the next who needs one: a search that is made, used and thrown
/// away would otherwise spend up to a third of its time on page faults.
class SpareBlocks {
 public:
  SpareBlocks() = default;
  SpareBlocks(const SpareBlocks&) = delete;
  SpareBlocks& operator=(const SpareBlocks&) = delete;
  ~SpareBlocks() {
    for (const Block& block : m_blocks) {
      if (block.memory != nullptr) munmap(block.memory, block.size);
    }
  }

  /// A block of that size, or null.
  void* take(std::size_t size) {
    for (Block& block : m_blocks) {
      if (block.memory == nullptr || block.size != size) continue;
      m_total -= size;
      return std::exchange(block.memory, nullptr);
    }
    return nullptr;
  }

  /// Whether the block has been kept.
  bool keep(void* memory, std::size_t size) {
    if (m_total + size > kMostKept) return false;
    for (Block& block : m_blocks) {
      if (block.memory != nullptr) continue;
      if (size >= kLargePage) lend(memory, size);
      block = {memory, size};
      m_total += size;
      return true;
    }
    return false;
  }

 private:
  struct Block {
    void* memory = nullptr;
    std::size_t size = 0;
  };
  std::array<Block, 32> m_blocks;
  std::size_t m_total = 0;
};

/// Each thread has its own, so that nobody waits.
SpareBlocks& spareBlocks() {
  thread_local SpareBlocks blocks;
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
  if (void* spare = spareBlocks().take(size); spare != nullptr) return spare;
  if (size >= kLargePage) return mapLarge(size);
  void* memory = map(size);
  if (memory != nullptr) touchPages(memory, bytes);
  return memory;
}

void freeMapped(void* memory, std::size_t bytes) {
  const std::size_t size = mappedSize(bytes);
  if (!spareBlocks().keep(memory, size)) munmap(memory, size);
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
