// SPDX-License-Identifier: MIT
//
// The pairs in memory of the caller, which is not filled with zeros first: it is raw, as a mapped file is. An array of
// Pair, even one from make_unique_for_overwrite, is, since the members of Pair have initial values.
#include <allpairs/Overlaps.h>

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <vector>

int main() {
  const std::vector<allpairs::Box> boxes{{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}, {{3, 3, 3}, {4, 4, 4}}};
  allpairs::OverlapSearch search;
  const std::uint64_t pairs = search.count(boxes);
  const auto memory = std::make_unique_for_overwrite<std::byte[]>(pairs * sizeof(allpairs::Pair));
  const auto found = search.findInto(boxes, {reinterpret_cast<allpairs::Pair*>(memory.get()), pairs});
  for (const auto& [first, second] : found) std::cout << first << " and " << second << '\n';
}
