// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "allpairs/scene/WriteResult.h"

namespace allpairs::view {

/// Writes bytes as base64 with padding (RFC 4648, section 4), without line breaks, some at a time.
void writeBase64(std::string_view bytes, scene::ByteSink sink);

}  // namespace allpairs::view
