// SPDX-License-Identifier: MIT
#pragma once

namespace allpairs::test {

/// Whether a sanitizer watches the program. It keeps freed memory for a while and has its own for each thread, so that
/// how much a process holds says little; and work takes many times as long.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kIsThreadSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kIsThreadSanitized = __has_feature(thread_sanitizer);
#else
inline constexpr bool kIsThreadSanitized = false;
#endif
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kIsSanitized = __has_feature(address_sanitizer) || kIsThreadSanitized;
#else
inline constexpr bool kIsSanitized = kIsThreadSanitized;
#endif

/// How often a test does anew, with other random inputs, what it repeats `often` times: under a sanitizer, where each
/// takes several times as long, a quarter as often. Sanitizers look for what every repetition does; answers are compared
/// by all of them where none is at work.
template <class Count>
constexpr Count repeats(Count often) {
  return kIsSanitized ? (often + 3) / 4 : often;
}

}  // namespace allpairs::test
