// SPDX-License-Identifier: MIT
// Linked with FailingAllocation.cpp, which replaces the program's allocation functions.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "support/Sanitizers.h"

namespace allpairs::test {

/// What fails besides the k-th allocation of an operation.
enum class Failing : std::uint8_t {
  Once,     ///< Nothing: memory is there again at once.
  Onwards,  ///< All that come after it, too.
};

/// Lets the k-th allocation from now on fail, on whatever thread it is made.
void startFailing(std::uint64_t k, Failing failing) noexcept;

/// Returns whether an allocation has failed.
bool stopFailing() noexcept;

/// Blocks that have been allocated and not freed.
[[nodiscard]] std::int64_t liveAllocations() noexcept;

/// The allocation that is to fail in one run of a scene.
class Fault {
 public:
  Fault(std::uint64_t k, Failing failing) : m_k(k), m_failing(failing) {}

  /// Runs an operation with the fault in it; returns whether the operation has ended without std::bad_alloc.
  ///
  /// To be called once in a scene.
  template <class Operation>
  bool during(Operation&& operation) {
    bool passed = false;
    startFailing(m_k, m_failing);
    try {
      std::forward<Operation>(operation)();
      passed = true;
    } catch (const std::bad_alloc&) {
      passed = false;
    } catch (...) {
      m_happened = stopFailing();
      throw;
    }
    m_happened = stopFailing();
    return passed;
  }

  [[nodiscard]] bool happened() const noexcept { return m_happened; }

 private:
  std::uint64_t m_k;
  Failing m_failing;
  bool m_happened = false;
};

/// Runs a scene with each allocation of its operation failing, until the operation makes no more of them: a scene makes
/// its objects, runs one operation by fault.during(), and checks that the objects can be used on. What it has allocated
/// is free at its end. Every `stride`th allocation is enough where there are many.
template <class Scene>
void failEachAllocation(const Scene& scene, std::uint64_t stride = 1) {
  if (kIsSanitized) stride = stride * 7 + 4;  // each run takes many times as long
  for (const Failing failing : {Failing::Once, Failing::Onwards}) {
    for (std::uint64_t k = 1;; k += stride) {
      SCOPED_TRACE("allocation " + std::to_string(k) + (failing == Failing::Once ? " fails" : " and later ones fail"));
      const std::int64_t before = liveAllocations();
      Fault fault(k, failing);
      scene(fault);
      if (::testing::Test::HasFailure()) return;
      ASSERT_EQ(liveAllocations(), before) << "a leak";
      if (!fault.happened()) {
        ASSERT_GT(k, 1U) << "nothing allocates";
        break;
      }
    }
  }
}

}  // namespace allpairs::test
