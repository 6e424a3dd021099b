// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace allpairs::view {

/// web/dist/viewer.html, which the build puts into the program.
[[nodiscard]] std::string_view pageTemplate();

/// web/dist/report.html, likewise.
[[nodiscard]] std::string_view reportTemplate();

}  // namespace allpairs::view
