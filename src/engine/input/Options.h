// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/BoxView.h"
#include "allpairs/OverlapOptions.h"
#include "kernels/Kernels.h"

namespace allpairs::engine {

/// The boxes to search: one set against itself, or two against each other.
struct Sets {
  const BoxView& first;
  const BoxView& second;
  bool one = true;
};

/// Throws InvalidArgument, with a message that names the setting, if options are invalid for these sets.
void checkOptions(const Sets& sets, const OverlapOptions& options);

/// The kernels that the options select; throws InvalidArgument for an unavailable instruction set.
[[nodiscard]] const Kernels& chooseKernels(const OverlapOptions& options);

}  // namespace allpairs::engine
