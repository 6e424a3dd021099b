// SPDX-License-Identifier: MIT
#pragma once

// -D_GLIBCXX_DEBUG changes the layout of the containers of GCC's standard library. If only the program or only the
// library is built with it, each would misread the other's memory. Instead they do not link, and the name of the
// missing symbol states the reason.
#ifdef _GLIBCXX_DEBUG
#define ALLPAIRS_CONTAINERS the_user_is_built_with_GLIBCXX_DEBUG_which_liballpairs_is_not
#else
#define ALLPAIRS_CONTAINERS the_user_is_built_without_GLIBCXX_DEBUG_with_which_liballpairs_is
#endif

namespace allpairs::containers {

extern const char ALLPAIRS_CONTAINERS;
#if defined(__GNUC__)  // of others the linker notices by itself
[[gnu::used]] static const char* const kAreAlike = &ALLPAIRS_CONTAINERS;
#endif

}  // namespace allpairs::containers
