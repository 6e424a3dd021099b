// SPDX-License-Identifier: MIT
#pragma once

// Options point to a std::pmr::memory_resource, which takes no more than its name. The header that defines it is larger
// than all that a search needs besides, so where the standard library is known to have the class in no inner namespace
// it is declared here; who makes one includes <memory_resource>.
#include <cstddef>

#if defined(__GLIBCXX__) && !_GLIBCXX_INLINE_VERSION
namespace std::pmr {  // NOLINT(cert-dcl58-cpp): a declaration of what is there
class memory_resource;
}  // namespace std::pmr
#else
#include <memory_resource>
#endif
