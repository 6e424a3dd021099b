// SPDX-License-Identifier: MIT
#pragma once

#include <array>  // std::data and std::size, of which <iterator> costs more
#include <cstddef>
#include <type_traits>
#include <utility>
#include <version>

#ifdef __cpp_lib_span
#include <span>
#endif

#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) < 201703L
#error "Allpairs needs C++17 or later: compile with -std=c++17"
#endif

#include "allpairs/DebugMode.h"

namespace allpairs {

template <class T>
class Span;

namespace internal {

/// Whether the elements of a range follow each other in memory. C++17 has no way to ask; there it is what has a
/// size_type, as the containers of the standard library have and the rows of a matrix of Eigen don't, and iterates over
/// what data() points to, as an array of several dimensions doesn't.
template <class Range, class = void>
inline constexpr bool kIsContiguous = std::is_array_v<Range>;
#ifdef __cpp_lib_span
template <class Range>
inline constexpr bool kIsContiguous<Range, std::enable_if_t<std::ranges::contiguous_range<Range>>> = true;
#else
template <class Range>
inline constexpr bool
    kIsContiguous<Range, std::void_t<typename Range::size_type, decltype(std::declval<Range&>().begin()),
                                     decltype(std::data(std::declval<Range&>()))>> =
        std::is_same_v<decltype(*std::declval<Range&>().begin()), decltype(*std::data(std::declval<Range&>()))>;
#endif

/// Whether what a range views outlives the range. In C++17 that is known of a Span.
template <class Range>
inline constexpr bool kIsBorrowed = false;
#ifdef __cpp_lib_span
template <class Range>
  requires std::ranges::enable_borrowed_range<Range>
inline constexpr bool kIsBorrowed<Range> = true;
#else
template <class T>
inline constexpr bool kIsBorrowed<Span<T>> = true;
#endif

/// Whether a range can be viewed as a Span<T>: its elements are T, but for const.
template <class Range, class T, class = void>
inline constexpr bool kIsRangeOf = false;
template <class Range, class T>
inline constexpr bool kIsRangeOf<
    Range, T, std::void_t<decltype(std::data(std::declval<Range&>())), decltype(std::size(std::declval<Range&>()))>> =
    kIsContiguous<Range> &&
    std::is_convertible_v<std::remove_pointer_t<decltype(std::data(std::declval<Range&>()))> (*)[], T (*)[]>;

}  // namespace internal

/// A view of elements that follow each other in memory: what std::span<T> is, from C++17 on, and one type in all
/// standards, so that programs of each use the same library. In C++20 either converts to the other.
///
/// Nothing is copied: the elements must outlive the view.
/// Bad input: an index or a range that is not within the view is undefined.
template <class T>
class Span {
 public:
  using element_type = T;
  using value_type = std::remove_cv_t<T>;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using pointer = T*;
  using const_pointer = const T*;
  using reference = T&;
  using const_reference = const T&;
  using iterator = T*;
  using const_iterator = const T*;

  constexpr Span() noexcept = default;
  /// From a pointer to T, not to a class derived from it, and never from a 0 that stands for a null pointer.
  template <class U, std::enable_if_t<std::is_convertible_v<U (*)[], T (*)[]>, int> = 0>
  constexpr Span(U* data, std::size_t size) noexcept : m_data(data), m_size(size) {}
#ifdef __cpp_lib_span
  /// From two iterators, or two pointers, in C++20.
  template <class First, class Last>
    requires(!std::is_convertible_v<Last, std::size_t> && std::is_constructible_v<std::span<T>, First, Last>)
  constexpr Span(First first, Last last) : Span(std::span<T>(first, last)) {}
#endif

  /// From a std::vector, std::array, std::span, C array or other container with data() and size(). As with std::span, a
  /// temporary gives elements that are const only, unless it is a view.
  // NOLINTBEGIN(google-explicit-constructor): a view of the same
  template <class Range,
            std::enable_if_t<!std::is_const_v<Range> && !std::is_same_v<Range, Span> && internal::kIsRangeOf<Range, T>,
                             int> = 0>
  constexpr Span(Range& range) : Span(std::data(range), static_cast<std::size_t>(std::size(range))) {}
  template <class Range,
            std::enable_if_t<!std::is_same_v<Range, Span> && internal::kIsRangeOf<const Range, T>, int> = 0>
  constexpr Span(const Range& range) : Span(std::data(range), static_cast<std::size_t>(std::size(range))) {}
  // NOLINTEND(google-explicit-constructor)

  [[nodiscard]] constexpr T* data() const noexcept { return m_data; }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return m_size; }
  [[nodiscard]] constexpr bool empty() const noexcept { return m_size == 0; }

  [[nodiscard]] constexpr T* begin() const noexcept { return m_data; }
  [[nodiscard]] constexpr T* end() const noexcept { return m_data + m_size; }

  [[nodiscard]] constexpr T& operator[](std::size_t i) const noexcept { return m_data[i]; }
  [[nodiscard]] constexpr T& front() const noexcept { return m_data[0]; }
  [[nodiscard]] constexpr T& back() const noexcept { return m_data[m_size - 1]; }

  [[nodiscard]] constexpr Span first(std::size_t count) const noexcept { return {m_data, count}; }
  [[nodiscard]] constexpr Span last(std::size_t count) const noexcept { return {m_data + (m_size - count), count}; }

  /// All from `begin` on, or `count` elements; the greatest count, std::dynamic_extent, means all too.
  [[nodiscard]] constexpr Span subspan(std::size_t begin,
                                       std::size_t count = static_cast<std::size_t>(-1)) const noexcept {
    return {m_data + begin, count == static_cast<std::size_t>(-1) ? m_size - begin : count};
  }

 private:
  T* m_data = nullptr;
  std::size_t m_size = 0;
};

}  // namespace allpairs

#ifdef __cpp_lib_span
// A range that outlives the object that describes it, as std::span is.
template <class T>
inline constexpr bool std::ranges::enable_borrowed_range<allpairs::Span<T>> = true;
template <class T>
inline constexpr bool std::ranges::enable_view<allpairs::Span<T>> = true;
#endif
