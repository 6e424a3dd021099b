// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace allpairs::app {

/// Opens a file or an address in the user's browser, through the desktop's xdg-open, or open on macOS.
///
/// Bad input: where there is no such program, or it fails, throws Error.
void openInBrowser(const std::string& target);

}  // namespace allpairs::app
