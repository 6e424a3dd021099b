// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace sofa::type {
template <class T>
using vector = std::vector<T>;
}  // namespace sofa::type
