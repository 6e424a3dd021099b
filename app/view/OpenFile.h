// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace allpairs::app {

/// Opens a file or an address in the user's browser, through the desktop's xdg-open, or open on macOS.
///
/// Bad input: where there is no such program, or it fails, throws Error.
void openInBrowser(const std::string& target);

/// The same where it is no failure that nothing opens by itself, as while a page is served: only says why on standard
/// error.
void tryToOpen(const std::string& target);

}  // namespace allpairs::app
