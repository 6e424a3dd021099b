// SPDX-License-Identifier: MIT
#include "input/Options.h"

#include <string>

#include "allpairs/Error.h"

namespace allpairs::engine {
namespace {

void checkSpan(std::span<const std::uint32_t> values, std::size_t size, const std::string& name) {
  if (values.empty() || values.size() == size) return;
  throw InvalidArgument("the filter has " + std::to_string(values.size()) + ' ' + name + " for " +
                        std::to_string(size) + " boxes");
}

void checkBits(const FilterBits& bits, std::size_t size) {
  checkSpan(bits.categories, size, "categories");
  checkSpan(bits.masks, size, "masks");
  checkSpan(bits.groups, size, "groups");
}

void checkRegion(const Box& region) {
  if (hasNan(region)) throw InvalidArgument("the region has a bound that is not a number (NaN)");
  if (isEmpty(region)) throw InvalidArgument("the region is empty: its min is above its max on some axis");
}

/// Whether an enumerator is one of those up to the last: it may have been cast from a number.
template <class Enum>
void checkValue(const char* name, Enum value, Enum last) {
  if (value > last) throw InvalidArgument("no " + std::string(name) + ' ' + std::to_string(static_cast<int>(value)));
}

}  // namespace

void checkRows(NeighborRows rows) { checkValue("kind of rows", rows, NeighborRows::Half); }

void checkDistance(double distance) {
  if (!isDistance(distance)) throw InvalidArgument("the distance is NaN or -infinity");
}

void checkOrder(Order order) { checkValue("order", order, Order::Unordered); }

void checkSettings(const OverlapOptions& options) {
  checkDistance(options.distance);
  checkOrder(options.order);
  checkValue("strategy", options.strategy, Strategy::Bvh);
  if (options.region) checkRegion(*options.region);
}

void checkOneSet(const Filter& filter) {
  if (!isEmpty(filter.second)) {
    throw InvalidArgument("filter.second is for a search between two sets; this one has one");
  }
}

void checkOptions(const Sets& sets, const OverlapOptions& options) {
  checkSettings(options);
  checkBits(options.filter.first, sets.first.size());
  sets.one ? checkOneSet(options.filter) : checkBits(options.filter.second, sets.second.size());
}

const Kernels& chooseKernels(std::string_view instructionSet) {
  if (const Kernels* kernels = findKernels(instructionSet)) return *kernels;
  std::string known;
  for (const std::string_view name : kernelNames()) known += (known.empty() ? "" : ", ") + std::string(name);
  throw InvalidArgument("no instruction set '" + std::string(instructionSet) + "' here; there are: " + known);
}

}  // namespace allpairs::engine
