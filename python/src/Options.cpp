// SPDX-License-Identifier: MIT
#include "Options.h"

#include <algorithm>
#include <utility>

#include "Arguments.h"
#include "Executors.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// Below this a search takes less than waking a pool of threads does.
constexpr std::size_t kWorthThreads = 20'000;

std::uint64_t keyOf(std::uint32_t first, std::uint32_t second) { return std::uint64_t{first} << 32U | second; }

/// Pairs to leave out, in ascending order.
std::vector<std::uint64_t> sortedKeys(std::span<const std::uint32_t> pairs, bool oneSet) {
  std::vector<std::uint64_t> keys;
  keys.reserve(pairs.size() / 2);
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const bool turn = oneSet && pairs[i] > pairs[i + 1];
    keys.push_back(turn ? keyOf(pairs[i + 1], pairs[i]) : keyOf(pairs[i], pairs[i + 1]));
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace

std::span<const std::uint32_t> Options::hold(const py::buffer& values) {
  m_held.push_back(std::make_unique<py::buffer_info>(requestBuffer(values, {"I", 0})));
  return valuesOf<std::uint32_t>(*m_held.back());
}

void Options::setGroups(Side side, const py::buffer& values) { bits(side).groups = hold(values); }
void Options::setCategories(Side side, const py::buffer& values) { bits(side).categories = hold(values); }
void Options::setMasks(Side side, const py::buffer& values) { bits(side).masks = hold(values); }

void Options::setIgnored(const py::buffer& pairs, bool oneSet) {
  const py::buffer_info info = requestBuffer(pairs, {"I", 2});
  engine.filter.accept = [keys = sortedKeys(valuesOf<std::uint32_t>(info), oneSet)](std::uint32_t a, std::uint32_t b) {
    return !std::binary_search(keys.begin(), keys.end(), keyOf(a, b));
  };
}

OverlapOptions Options::withExecutor(std::size_t boxes) {
  if (boxes >= kWorthThreads && !m_executor) m_executor = executorOf(threads);
  engine.executor = m_executor.get();
  return engine;
}

}  // namespace allpairs::python
