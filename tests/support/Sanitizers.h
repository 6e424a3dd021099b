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

}  // namespace allpairs::test
