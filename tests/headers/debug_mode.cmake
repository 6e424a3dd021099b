# Links a program with the library, as it is and in the debug mode of the standard library.

foreach(standard IN ITEMS c++17 c++20)
  set(command ${COMPILER} -std=${standard} -I ${INCLUDE})
  execute_process(COMMAND ${command} ${SOURCE} ${LIBRARIES} -pthread -o ${PROGRAM} RESULT_VARIABLE result ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "the program doesn't link as it is, in ${standard}:\n${output}")
  endif()
  execute_process(COMMAND ${command} -D_GLIBCXX_DEBUG ${SOURCE} ${LIBRARIES} -pthread -o ${PROGRAM} RESULT_VARIABLE result
                  ERROR_VARIABLE output)
  if(result EQUAL 0 OR NOT output MATCHES "the_user_is_built_with_GLIBCXX_DEBUG_which_liballpairs_is_not")
    message(FATAL_ERROR "a program with _GLIBCXX_DEBUG, in ${standard}: ${result}\n${output}")
  endif()
endforeach()
