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

/// The number of random inputs that a test takes: `count`, or a quarter of it under a sanitizer, where each takes several
/// times as long. A few inputs reach the code that a sanitizer watches; all of them are compared in builds without one.
template <class Count>
constexpr Count repeats(Count count) {
  return kIsSanitized ? (count + 3) / 4 : count;
}

}  // namespace allpairs::test
