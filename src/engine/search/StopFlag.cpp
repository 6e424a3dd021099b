// SPDX-License-Identifier: MIT
#include "allpairs/StopFlag.h"

#include <atomic>

namespace allpairs {

static_assert(std::atomic_ref<bool>::is_always_lock_free);  // for signal handlers

void StopFlag::set() noexcept { std::atomic_ref(m_isSet).store(true, std::memory_order_relaxed); }
void StopFlag::clear() noexcept { std::atomic_ref(m_isSet).store(false, std::memory_order_relaxed); }
bool StopFlag::isSet() const noexcept { return std::atomic_ref(m_isSet).load(std::memory_order_relaxed); }

}  // namespace allpairs
