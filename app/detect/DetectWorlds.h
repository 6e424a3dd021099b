// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/Options.h"
#include "cli/Output.h"
#include "detect/Detection.h"

namespace allpairs::app {

/// Reads a .npy file of shape (w, n, 6), w worlds of n boxes, and writes the pairs of each world: boxes of different
/// worlds are never pairs. Returns how many there are.
///
/// Bad input: more than one input, or another file, throws UsageError or FileError; with options.verify, strategies
///            that disagree throw collision::VerificationError.
std::size_t detectWorlds(const InputSettings& input, const DetectionOptions& options, const std::string& format,
                         Output& output);

}  // namespace allpairs::app
