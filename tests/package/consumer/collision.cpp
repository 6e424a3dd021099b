// SPDX-License-Identifier: MIT
#include <allpairs/collision/CollisionModel.h>

int main() {}
