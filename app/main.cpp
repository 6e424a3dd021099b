// SPDX-License-Identifier: MIT
#include "CommandLine.h"

int main(int count, char** arguments) { return allpairs::app::runCommandLine(count, arguments); }
