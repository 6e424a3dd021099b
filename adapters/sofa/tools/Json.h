// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace allpairs::tools {

/// A text as JSON; characters below the blank become '?'.
[[nodiscard]] std::string quoted(const std::string& text);

/// All digits of a number as JSON, which has no infinity and no NaN: those are texts, as `allpairs detect` writes them.
[[nodiscard]] std::string jsonNumber(double value);

}  // namespace allpairs::tools
