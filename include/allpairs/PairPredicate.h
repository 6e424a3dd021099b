// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace allpairs {

namespace internal {

/// Whether a callable can be compared with null, as pointers to functions and a std::function can.
template <class Callable, class = void>
inline constexpr bool kMayBeNull = false;
template <class Callable>
inline constexpr bool kMayBeNull<Callable, std::void_t<decltype(std::declval<Callable&>() == nullptr)>> = true;

}  // namespace internal

/// Says of two boxes whether they may be a pair: what std::function<bool(std::uint32_t, std::uint32_t)> is, without the
/// header of that, which is larger than all that a search needs besides. Copies hold copies of the callable.
///
/// Bad input: an empty one must not be called.
class PairPredicate {
 public:
  PairPredicate() = default;
  PairPredicate(std::nullptr_t) noexcept {}  // NOLINT(google-explicit-constructor): no predicate

  /// From a callable; from a null pointer to a function, or an empty std::function, none.
  template <class Callable,
            std::enable_if_t<std::conjunction_v<std::negation<std::is_same<Callable, PairPredicate>>,
                                                std::is_invocable_r<bool, Callable&, std::uint32_t, std::uint32_t>,
                                                std::is_copy_constructible<Callable>>,
                             int> = 0>
  PairPredicate(Callable callable) {  // NOLINT(google-explicit-constructor): meant to convert
    if constexpr (internal::kMayBeNull<Callable>) {
      if (callable == nullptr) return;
    }
    m_held = new Holder<Callable>(std::move(callable));  // NOLINT(*-owning-memory): without <memory>
  }

  PairPredicate(const PairPredicate& other) : m_held(other.m_held != nullptr ? other.m_held->copy() : nullptr) {}
  PairPredicate(PairPredicate&& other) noexcept : m_held(std::exchange(other.m_held, nullptr)) {}
  PairPredicate& operator=(PairPredicate other) noexcept {
    std::swap(m_held, other.m_held);
    return *this;
  }
  ~PairPredicate() { delete m_held; }

  explicit operator bool() const noexcept { return m_held != nullptr; }

  bool operator()(std::uint32_t first, std::uint32_t second) const { return m_held->ask(first, second); }

 private:
  // NOLINTBEGIN(cppcoreguidelines-special-member-functions): held by pointer only
  struct Held {
    virtual ~Held() = default;
    [[nodiscard]] virtual Held* copy() const = 0;
    virtual bool ask(std::uint32_t first, std::uint32_t second) = 0;
  };
  // NOLINTEND(cppcoreguidelines-special-member-functions)

  template <class Callable>
  struct Holder final : Held {
    explicit Holder(Callable&& given) : callable(std::move(given)) {}
    explicit Holder(const Callable& given) : callable(given) {}
    [[nodiscard]] Held* copy() const override { return new Holder(callable); }  // NOLINT(*-owning-memory)
    bool ask(std::uint32_t first, std::uint32_t second) override { return callable(first, second); }

    Callable callable;
  };

  Held* m_held = nullptr;
};

}  // namespace allpairs
