// SPDX-License-Identifier: MIT
// The same kernels with one lane, for the tests of the others and for processors without vectors.
#undef HWY_COMPILE_ONLY_STATIC  // a project that builds us may ask for it
#define HWY_COMPILE_ONLY_SCALAR
#include "hwy/highway.h"
//
#include "kernels/KernelTable-inl.h"

namespace allpairs::engine {

const Kernels& scalarKernels() { return *N_SCALAR::kernelTable(); }

}  // namespace allpairs::engine
