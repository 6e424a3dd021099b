// SPDX-License-Identifier: MIT
// What SOFA's plugin manager looks for in a plugin.
#include <Allpairs/config.h>
#include <sofa/core/ObjectFactory.h>

namespace allpairs::plugin {

void registerAllpairsBroadPhase(sofa::core::ObjectFactory* factory);

}  // namespace allpairs::plugin

extern "C" {

ALLPAIRS_SOFA_API void initExternalModule() {}  // nothing to prepare, but a plugin must have it

ALLPAIRS_SOFA_API const char* getModuleName() { return "Allpairs"; }
ALLPAIRS_SOFA_API const char* getModuleVersion() { return ALLPAIRS_SOFA_VERSION; }
ALLPAIRS_SOFA_API const char* getModuleLicense() { return "MIT"; }
ALLPAIRS_SOFA_API const char* getModuleDescription() { return "Exact broad phase at the speed of the hardware"; }

ALLPAIRS_SOFA_API void registerObjects(sofa::core::ObjectFactory* factory) {
  allpairs::plugin::registerAllpairsBroadPhase(factory);
}
}
