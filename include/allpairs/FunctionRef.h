// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <utility>

namespace allpairs {

template <class Signature>
class FunctionRef;

/// A non-owning reference to a callable; does not allocate.
///
/// The callable must outlive the FunctionRef, as a function argument outlives the call.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Callable,
            std::enable_if_t<std::conjunction_v<std::negation<std::is_same<std::decay_t<Callable>, FunctionRef>>,
                                                std::is_invocable_r<Result, Callable&, Arguments...>>,
                             int> = 0>
  FunctionRef(Callable&& callable) noexcept  // NOLINT(google-explicit-constructor): meant to convert
      : m_object(addressOf(callable)), m_call([](void* object, Arguments... arguments) -> Result {
          if constexpr (std::is_function_v<std::remove_reference_t<Callable>>) {
            return reinterpret_cast<std::remove_reference_t<Callable>*>(object)(std::forward<Arguments>(arguments)...);
          } else {
            return (*static_cast<std::remove_reference_t<Callable>*>(object))(std::forward<Arguments>(arguments)...);
          }
        }) {}

  Result operator()(Arguments... arguments) const { return m_call(m_object, std::forward<Arguments>(arguments)...); }

 private:
  template <class Callable>
  static void* addressOf(Callable& callable) noexcept {
    if constexpr (std::is_function_v<Callable>) {
      return reinterpret_cast<void*>(&callable);
    } else {
      return const_cast<void*>(static_cast<const void*>(&callable));
    }
  }

  void* m_object;
  Result (*m_call)(void*, Arguments...);
};

}  // namespace allpairs
