// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/config.h>
#include <sofa/type/fixed_array.h>

namespace sofa::type {
using Vec3 = fixed_array<SReal, 3>;
}  // namespace sofa::type
