// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "NumberArray.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::python {

/// Pairs as rows of two numbers.
inline std::unique_ptr<OffsetArray> arrayOf(const std::vector<partition::IdPair>& pairs) {
  std::vector<std::uint64_t> numbers;
  numbers.reserve(2 * pairs.size());
  for (const partition::IdPair& pair : pairs) numbers.insert(numbers.end(), {pair.first, pair.second});
  return arrayOf(std::move(numbers), 2);
}

}  // namespace allpairs::python
