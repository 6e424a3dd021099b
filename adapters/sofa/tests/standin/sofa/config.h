// SPDX-License-Identifier: MIT
// A stand-in for the few interfaces of SOFA that the plugin uses, so that it can be compiled and tested without SOFA.
// It does what SOFA's documentation says of them and no more.
#pragma once

#define SOFA_EXPORT_DYNAMIC_LIBRARY
#define SOFA_IMPORT_DYNAMIC_LIBRARY

using SReal = double;

namespace sofa {
using Size = unsigned int;
using Index = unsigned int;
}  // namespace sofa
