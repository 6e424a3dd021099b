// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace allpairs::view {

/// web/dist/viewer.html, which the build puts into the program.
[[nodiscard]] std::string_view pageTemplate();

}  // namespace allpairs::view
