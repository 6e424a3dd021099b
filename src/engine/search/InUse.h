// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>

#include "allpairs/Error.h"

namespace allpairs::engine {

/// Whether an object is at work. What its own callbacks ask of it then would change what it works on.
///
/// Threads: tasks of the work that is going on may check.
class InUse {
 public:
  /// For as long as work goes on.
  class Scope {
   public:
    explicit Scope(InUse& inUse) noexcept : m_inUse(inUse) { ++m_inUse.m_scopes; }
    ~Scope() { --m_inUse.m_scopes; }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    InUse& m_inUse;
  };

  /// Throws InvalidArgument that names the kind of object if it is.
  void check(const char* object) const {
    if (m_scopes != 0) throw InvalidArgument(std::string(object) + " is called by its own filter, visitor or task");
  }

 private:
  std::atomic<int> m_scopes = 0;
};

}  // namespace allpairs::engine
