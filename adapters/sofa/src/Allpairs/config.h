// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/config.h>

#ifdef ALLPAIRS_BUILD_SOFA_PLUGIN
/// SOFA writes this name beside each component of the plugin.
#define SOFA_TARGET Allpairs
#define ALLPAIRS_SOFA_API SOFA_EXPORT_DYNAMIC_LIBRARY
#else
#define ALLPAIRS_SOFA_API SOFA_IMPORT_DYNAMIC_LIBRARY
#endif
