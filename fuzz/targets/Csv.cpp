// SPDX-License-Identifier: MIT
#include "../BoxFile.h"

namespace allpairs::fuzz {
namespace {

void runCsv(Bytes bytes) { readBoxes(writeFile("input.csv", bytes)); }

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(csv, allpairs::fuzz::runCsv)
