// SPDX-License-Identifier: MIT
#pragma once

// With -D_GLIBCXX_DEBUG the containers of the standard library are laid out otherwise. A program and a library of which
// only one is built with it would read each other's memory wrongly; here they don't link, and the name that is missing
// says why.
#ifdef _GLIBCXX_DEBUG
#define ALLPAIRS_CONTAINERS the_user_is_built_with_GLIBCXX_DEBUG_which_liballpairs_is_not
#else
#define ALLPAIRS_CONTAINERS the_user_is_built_without_GLIBCXX_DEBUG_with_which_liballpairs_is
#endif

namespace allpairs::containers {

extern const char ALLPAIRS_CONTAINERS;
[[gnu::used]] static const char* const kAreAlike = &ALLPAIRS_CONTAINERS;

}  // namespace allpairs::containers
