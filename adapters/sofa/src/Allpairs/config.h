// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/config.h>

#ifdef ALLPAIRS_BUILD_SOFA_PLUGIN
#define ALLPAIRS_SOFA_API SOFA_EXPORT_DYNAMIC_LIBRARY
#else
#define ALLPAIRS_SOFA_API SOFA_IMPORT_DYNAMIC_LIBRARY
#endif
