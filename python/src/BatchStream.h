// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "allpairs/Overlaps.h"

namespace allpairs::python {

/// Turns a search that hands over batches into one that is asked for them: the search runs in a thread of its own and
/// waits whenever a batch has not been fetched yet, so that at most two are held.
///
/// Threads: next() and close() from one thread at a time.
class BatchStream {
 public:
  /// Called with what receives batches, and the flag that stops the search.
  using Search = std::function<void(PairVisitor, const StopFlag& stop)>;

  explicit BatchStream(Search search);
  BatchStream(const BatchStream&) = delete;
  BatchStream& operator=(const BatchStream&) = delete;
  ~BatchStream();

  /// Whether next() has something to give, within that time.
  [[nodiscard]] bool isSoonReady(std::chrono::milliseconds time);

  /// The next batch; nothing after the last. What the search throws is thrown here, once.
  [[nodiscard]] std::optional<std::vector<Pair>> next();

  /// Ends the search before its end; next() gives nothing from then on.
  void close() noexcept;

 private:
  void run(const Search& search) noexcept;
  void put(std::span<const Pair> batch);

  std::mutex m_mutex;
  std::condition_variable m_changed;
  std::optional<std::vector<Pair>> m_batch;
  std::exception_ptr m_error;
  bool m_done = false;
  StopFlag m_stop;
  std::thread m_thread;
};

}  // namespace allpairs::python
