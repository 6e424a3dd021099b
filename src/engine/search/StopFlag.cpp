// SPDX-License-Identifier: MIT
#include "allpairs/StopFlag.h"

#include "allpairs/Error.h"
#include "memory/Platform.h"

namespace allpairs {

void StopFlag::set() noexcept { engine::storeFlag(m_isSet, true); }
void StopFlag::clear() noexcept { engine::storeFlag(m_isSet, false); }
bool StopFlag::isSet() const noexcept { return engine::loadFlag(m_isSet) || (m_ask && (*m_ask)()); }

void checkStop(const StopFlag* stop) {
  if (stop != nullptr && stop->isSet()) throw Stopped();
}

}  // namespace allpairs
