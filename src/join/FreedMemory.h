// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace allpairs::join {

/// A step's memory is the next one's: what was freed goes back to the system where the C library would keep it. Setting
/// from what size on it does not would be for all of a host program.
inline void releaseFreedMemory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace allpairs::join
