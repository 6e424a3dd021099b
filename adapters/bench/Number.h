// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>

/// The argument at a place, a number above 0, or without one the default; ends the program with a line if it is none.
inline int numberAt(int place, int count, char** arguments, int otherwise) {
  if (count <= place) return otherwise;
  const char* const end = arguments[place] + std::strlen(arguments[place]);
  int number = 0;
  const auto [last, error] = std::from_chars(arguments[place], end, number);
  if (error == std::errc() && last == end && number > 0) return number;
  std::fprintf(stderr, "%s: '%s' is not a number above 0\n", arguments[0], arguments[place]);
  std::exit(2);
}
