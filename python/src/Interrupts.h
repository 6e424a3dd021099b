// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

#include "allpairs/FunctionRef.h"
#include "allpairs/StopFlag.h"

namespace allpairs::python {

/// How often a call that waits for a search looks for signals.
inline constexpr std::chrono::milliseconds kBetweenLooks{20};

/// Stops the search of one call, which may not have begun yet.
class Stopper {
 public:
  /// While it lives, the flag that a search reads is this call's.
  class Hold {
   public:
    Hold(Stopper& stopper, StopFlag& flag) : m_stopper(stopper) { m_stopper.reset(&flag); }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() { m_stopper.reset(nullptr); }

   private:
    Stopper& m_stopper;
  };

  void stop();

 private:
  void reset(StopFlag* flag);

  std::mutex m_mutex;
  StopFlag* m_flag = nullptr;
  bool m_isStopped = false;
};

/// Runs work without the GIL; called with it. With so many boxes that it may take long, it runs in another thread, while
/// this one has Python handle signals. If a handler raises an exception, as that of Ctrl-C does, the work is stopped,
/// and once it has ended the exception is thrown.
void watchSignals(std::size_t boxes, FunctionRef<void(Stopper&)> work);

/// The same for work that returns something.
template <class Work>
auto interruptibly(std::size_t boxes, const Work& work) {
  using Result = std::invoke_result_t<const Work&, Stopper&>;
  if constexpr (std::is_void_v<Result>) {
    watchSignals(boxes, work);
  } else {
    std::optional<Result> result;
    const auto keep = [&](Stopper& stopper) { result.emplace(work(stopper)); };
    watchSignals(boxes, keep);
    return std::move(*result);
  }
}

}  // namespace allpairs::python
