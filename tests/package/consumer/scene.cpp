// SPDX-License-Identifier: MIT
#include <allpairs/scene/Scene.h>

int main() {}
