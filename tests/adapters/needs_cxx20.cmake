# An adapter's header is refused as C++17, with one error, which says what it needs.

file(WRITE "${SOURCE}" "#include <${HEADER}>\n")
execute_process(COMMAND ${COMPILER} -std=c++17 -fsyntax-only ${OPTIONS} ${SOURCE} RESULT_VARIABLE result ERROR_VARIABLE output)
string(REGEX MATCHALL "error:" errors "${output}")
list(LENGTH errors count)
if(result EQUAL 0
   OR NOT count EQUAL 1
   OR NOT output MATCHES "needs C\\+\\+20")
  message(FATAL_ERROR "${HEADER} as C++17: ${count} errors\n${output}")
endif()
