// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace allpairs::app {

/// Serves one page at http://127.0.0.1:port/ until the program is ended; port 0 means any that is free. `ready` is told
/// the address when it can be asked.
///
/// Nobody but this machine can ask, and only under the names 127.0.0.1 and localhost, so that no page of the network
/// can read it through a name of its own.
/// Bad input: a port that cannot be had throws Error.
void servePage(const std::string& page, int port, const std::function<void(const std::string&)>& ready);

}  // namespace allpairs::app
