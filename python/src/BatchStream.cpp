// SPDX-License-Identifier: MIT
#include "BatchStream.h"

#include <utility>

#include "allpairs/Error.h"

namespace allpairs::python {

BatchStream::BatchStream(Search search) : m_thread([this, search = std::move(search)] { run(search); }) {}
BatchStream::~BatchStream() { close(); }

void BatchStream::run(const Search& search) noexcept {
  std::exception_ptr error;
  try {
    search([this](std::span<const Pair> batch) { put(batch); }, m_stop);
  } catch (const Stopped&) {
    error = nullptr;  // the rest is not needed
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(m_mutex);
  m_error = error;
  m_done = true;
  m_changed.notify_all();
}

void BatchStream::put(std::span<const Pair> batch) {
  std::vector<Pair> pairs(batch.begin(), batch.end());
  std::unique_lock lock(m_mutex);
  m_changed.wait(lock, [this] { return m_stop.isSet() || !m_batch; });
  if (m_stop.isSet()) throw Stopped();
  m_batch = std::move(pairs);
  m_changed.notify_all();
}

bool BatchStream::isSoonReady(std::chrono::milliseconds time) {
  std::unique_lock lock(m_mutex);
  return m_changed.wait_for(lock, time, [this] { return m_batch || m_done; });
}

std::optional<std::vector<Pair>> BatchStream::next() {
  std::unique_lock lock(m_mutex);
  m_changed.wait(lock, [this] { return m_batch || m_done; });
  std::optional<std::vector<Pair>> batch = std::exchange(m_batch, std::nullopt);
  m_changed.notify_all();
  if (!batch && m_error) std::rethrow_exception(std::exchange(m_error, nullptr));
  return batch;
}

void BatchStream::close() noexcept {
  {
    const std::lock_guard lock(m_mutex);
    m_stop.set();
    m_batch.reset();
    m_changed.notify_all();
  }
  if (m_thread.joinable()) m_thread.join();
}

}  // namespace allpairs::python
