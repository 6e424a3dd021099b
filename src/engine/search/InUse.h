// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>

#include "allpairs/Error.h"

namespace allpairs::engine {

/// Marks an object as running. Calls from its own callbacks would then change the data that it works on.
///
/// Threads: tasks of the running work may call check().
class InUse {
 public:
  /// Marks the object as running while the scope exists.
  class Scope {
   public:
    explicit Scope(InUse& inUse) noexcept : m_inUse(inUse) { m_inUse.add(1); }
    ~Scope() { m_inUse.add(-1); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    InUse& m_inUse;
  };

  /// Throws InvalidArgument, which names the kind of object, if the object is running.
  void check(const char* object) const {
    if (m_scopes.load(std::memory_order_relaxed) != 0)
      throw InvalidArgument(std::string(object) + " is called by its own filter, visitor or task");
  }

 private:
  /// Only the thread that uses the object changes the number; a locked addition would cost more than a small search.
  void add(int scopes) noexcept {
    m_scopes.store(m_scopes.load(std::memory_order_relaxed) + scopes, std::memory_order_relaxed);
  }

  std::atomic<int> m_scopes = 0;
};

}  // namespace allpairs::engine
