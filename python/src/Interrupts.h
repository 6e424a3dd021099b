// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

#include "allpairs/FunctionRef.h"
#include "allpairs/StopFlag.h"

namespace allpairs::python {

/// How often a call that waits for a search looks for signals.
inline constexpr std::chrono::milliseconds kBetweenLooks{20};

/// As many boxes, of work that may take long whatever it is given.
inline constexpr std::size_t kLong = std::size_t{1} << 30;

class Stopper;

/// The flag that searches of one object read, each in the call that has begun it.
class CallFlag {
 public:
  CallFlag() = default;
  CallFlag(const CallFlag&) = delete;
  CallFlag& operator=(const CallFlag&) = delete;

  [[nodiscard]] const StopFlag& flag() const noexcept { return m_flag; }

  /// What a search asks when it looks at the flag.
  bool operator()() const noexcept;

 private:
  friend class Stopper;

  Stopper* m_stopper = nullptr;
  StopFlag m_flag{*this};
};

/// Stops the search of one call, which may not have begun yet.
class Stopper {
 public:
  enum class Asks : std::uint8_t {
    Nobody,
    Python,  ///< When the search looks at its flag in the thread that made this, whether Ctrl-C has been pressed.
  };

  explicit Stopper(Asks asks) : m_asker(asks == Asks::Python ? std::this_thread::get_id() : std::thread::id()) {}
  Stopper(const Stopper&) = delete;
  Stopper& operator=(const Stopper&) = delete;

  /// Python learns again of the Ctrl-C that it has been asked for.
  ~Stopper();

  /// While it lives, the flag that a search reads is this call's.
  class Hold {
   public:
    Hold(Stopper& stopper, CallFlag& flag) : m_stopper(stopper) { m_stopper.reset(&flag); }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() { m_stopper.reset(nullptr); }

   private:
    Stopper& m_stopper;
  };

  void stop();

  /// Whether Ctrl-C has been pressed, as far as it was asked for.
  [[nodiscard]] bool isInterrupted() const noexcept { return m_isInterrupted; }

 private:
  friend class CallFlag;

  void reset(CallFlag* flag);
  bool ask();

  std::mutex m_mutex;
  CallFlag* m_flag = nullptr;
  bool m_isStopped = false;

  // Used by one thread.
  std::thread::id m_asker;
  std::size_t m_looks = 0;
  std::chrono::steady_clock::time_point m_asked = std::chrono::steady_clock::now();
  bool m_isInterrupted = false;
};

/// Whether a search has an executor: then the thread that called may wait for others for long without looking.
enum class Runs : std::uint8_t { Alone, OnThreads };

/// Runs work without the GIL; called with it. With so many boxes that it may take long, it runs in another thread,
/// while this one has Python handle signals. If a handler raises an exception, as that of Ctrl-C does, the work is
/// stopped, and once it has ended the exception is thrown. With fewer boxes it runs in this thread, where Ctrl-C stops
/// it; if the handler raises nothing, it begins again, in another thread.
void watchSignals(std::size_t boxes, Runs runs, FunctionRef<void(Stopper&)> work);

/// The same for work that returns something.
template <class Work>
auto interruptibly(std::size_t boxes, Runs runs, const Work& work) {
  using Result = std::invoke_result_t<const Work&, Stopper&>;
  if constexpr (std::is_void_v<Result>) {
    watchSignals(boxes, runs, work);
  } else {
    std::optional<Result> result;
    const auto keep = [&](Stopper& stopper) { result.emplace(work(stopper)); };
    watchSignals(boxes, runs, keep);
    return std::move(*result);
  }
}

/// The same for work(flag), where no object has a flag that searches read.
template <class Work>
auto stoppably(std::size_t boxes, Runs runs, const Work& work) {
  CallFlag stop;
  return interruptibly(boxes, runs, [&](Stopper& stopper) {
    const Stopper::Hold hold(stopper, stop);
    return work(stop.flag());
  });
}

}  // namespace allpairs::python
