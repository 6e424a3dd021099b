// SPDX-License-Identifier: MIT
#pragma once

#include "Kernels.h"
#include "Search.h"
#include "allpairs/OverlapOptions.h"

namespace allpairs::engine {

/// Throws InvalidArgument, with a message that names the setting, where options make no sense for these sets.
void checkOptions(const Sets& sets, const OverlapOptions& options);

/// The kernels that the options ask for; throws InvalidArgument for an instruction set that is not there.
[[nodiscard]] const Kernels& chooseKernels(const OverlapOptions& options);

}  // namespace allpairs::engine
