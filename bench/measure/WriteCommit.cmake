# Writes OUTPUT, a header that names the commit of SOURCE; leaves it alone if nothing changed, so that nothing is rebuilt.

execute_process(
  COMMAND git describe --always --dirty --abbrev=12 --match=
  WORKING_DIRECTORY "${SOURCE}"
  OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
set(text "#pragma once\n#define ALLPAIRS_COMMIT \"${commit}\"\n")

if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" before)
endif()
if(NOT "${before}" STREQUAL "${text}")
  file(WRITE "${OUTPUT}" "${text}")
endif()
