# What the package tests have in common.

# Runs a command; its output is shown, and the test ends, only when it fails.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\n${output}\nfailed: ${result}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Configures the consumer project in `folder`, with the project's own compiler and flags; more arguments go to CMake.
function(configure_consumer folder)
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${folder} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
      "-DCMAKE_CXX_FLAGS=${FLAGS}" ${ARGN})
endfunction()

# Builds the consumer in `folder` and runs each of its programs.
function(build_and_run folder)
  run(${CMAKE_COMMAND} --build ${folder})
  file(GLOB programs ${folder}/use_*)
  if(NOT programs)
    message(FATAL_ERROR "the consumer built no program in ${folder}")
  endif()
  foreach(program IN LISTS programs)
    run(${program})
    message("${program}: ${output}")
  endforeach()
endfunction()
