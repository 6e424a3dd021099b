// SPDX-License-Identifier: MIT
#pragma once

namespace sofa::defaulttype {
class Vec3Types {};
class Rigid3Types {};
}  // namespace sofa::defaulttype
