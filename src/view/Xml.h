// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace allpairs::view {

/// The text as it may stand in XML and HTML, between tags and in quoted attributes. Characters that XML does not have
/// become U+FFFD, and so do bytes that are no UTF-8.
[[nodiscard]] std::string escapeXml(std::string_view text);

}  // namespace allpairs::view
