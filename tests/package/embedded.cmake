# Uses the source tree from another project, without installing it: the engine alone, by add_subdirectory; the engine and
# the component, by FetchContent.

include(${CMAKE_CURRENT_LIST_DIR}/Steps.cmake)
file(REMOVE_RECURSE ${WORK})
string(APPEND FLAGS " -DHWY_COMPILE_ONLY_STATIC") # the kernels of one instruction set take a seventh of the time of all

# Fails unless exactly these of our libraries and programs have been built in `folder`.
function(expect_built folder)
  file(GLOB_RECURSE built RELATIVE ${folder} ${folder}/liballpairs* ${folder}/allpairs ${folder}/example_* ${folder}/*_tests)
  list(FILTER built EXCLUDE REGEX "CMakeFiles")
  list(TRANSFORM built REPLACE ".*/(lib[a-z_]+)[^/]*$" "\\1")
  list(REMOVE_DUPLICATES built)
  list(SORT built)
  if(NOT "${built}" STREQUAL "${ARGN}")
    message(FATAL_ERROR "built in ${folder}: ${built}; expected: ${ARGN}")
  endif()
endfunction()

# Fails if a build in `folder` has more steps, or compiles something of ours that is not of these folders of src.
function(expect_steps folder most)
  if(NOT GENERATOR STREQUAL "Ninja")
    return()
  endif()
  run(ninja -C ${folder} -n -v)
  string(REGEX MATCHALL "\\[[0-9]+/[0-9]+\\] [^\n]*" steps "${output}")
  list(LENGTH steps count)
  message("${folder}: ${count} steps")
  if(count GREATER most)
    message(FATAL_ERROR "${count} steps in ${folder}, expected at most ${most}:\n${output}")
  endif()
  list(JOIN ARGN "|" folders)
  string(REGEX MATCHALL " -o [^ ]*allpairs[^ ]*/src/[a-z]+/" compiled "${output}")
  list(FILTER compiled EXCLUDE REGEX "/src/(${folders})/$")
  if(compiled)
    message(FATAL_ERROR "${folder} compiles more than ${ARGN}: ${compiled}")
  endif()
endfunction()

# The settings are those that such a project has by default: it says nothing of ours.
set(SOURCE ${CMAKE_CURRENT_LIST_DIR}/subproject)
configure_consumer(${WORK}/subproject -D ALLPAIRS_SOURCE=${ALLPAIRS_SOURCE} -D BUILD_SHARED_LIBS=${SHARED})
expect_steps(${WORK}/subproject 29 engine)
if(GENERATOR STREQUAL "Ninja" AND NOT FLAGS MATCHES "-O")
  run(ninja -C ${WORK}/subproject -n -v)
  if(NOT output MATCHES "-O2")
    message(FATAL_ERROR "the engine is compiled unoptimised")
  endif()
endif()
build_and_run(${WORK}/subproject)
expect_built(${WORK}/subproject liballpairs)
foreach(package TBB assimp fcl Bullet SofaFramework GTest) # whose folders find_package would keep
  file(STRINGS ${WORK}/subproject/CMakeCache.txt found REGEX "^${package}_DIR:")
  if(found)
    message(FATAL_ERROR "the engine alone was configured with a search for ${package}")
  endif()
endforeach()

# Installed with that project, ours is in what that project packs, if anything: it makes no packages of its own.
configure_consumer(${WORK}/installed -D ALLPAIRS_SOURCE=${ALLPAIRS_SOURCE} -D ALLPAIRS_INSTALL=ON)
if(EXISTS ${WORK}/installed/CPackConfig.cmake)
  message(FATAL_ERROR "a project that packs nothing is packed as Allpairs")
endif()
file(READ ${WORK}/installed/allpairs/cmake_install.cmake rules)
if(NOT rules MATCHES "AllpairsConfig.cmake")
  message(FATAL_ERROR "ALLPAIRS_INSTALL=ON installs nothing")
endif()

# What is not to be installed is not, the command neither.
if(APP)
  configure_consumer(${WORK}/commands -D ALLPAIRS_SOURCE=${ALLPAIRS_SOURCE} -D ALLPAIRS_BUILD_APP=ON -D ALLPAIRS_BUILD_SCENE=ON
                     -D ALLPAIRS_BUILD_PARALLEL=ON)
  file(GLOB_RECURSE scripts ${WORK}/commands/allpairs/cmake_install.cmake)
  foreach(script IN LISTS scripts)
    file(READ ${script} rules)
    if(rules MATCHES "file\\(INSTALL")
      message(FATAL_ERROR "installs without ALLPAIRS_INSTALL: ${script}")
    endif()
  endforeach()
endif()

# A project that is C++17, which ours is not for it, is debugged, wants no warnings and is compiled many sources at a time.
set(SOURCE ${CMAKE_CURRENT_LIST_DIR}/consumer)
configure_consumer(${WORK}/build -D ALLPAIRS_SOURCE=${ALLPAIRS_SOURCE} -D PARTS=engine,collision -D
                   BUILD_SHARED_LIBS=${SHARED} -D CMAKE_CXX_STANDARD=17
                   -D CMAKE_BUILD_TYPE=Debug -D CMAKE_COMPILE_WARNING_AS_ERROR=ON
                   -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=32)
expect_steps(${WORK}/build 81 engine collision)
build_and_run(${WORK}/build)
expect_built(${WORK}/build liballpairs liballpairs_collision)

# A part without what it needs is refused before anything is compiled.
function(expect_refusal said_of)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../.. -B ${WORK}/partly ${ARGN}
                  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE said)
  if(status EQUAL 0 OR NOT said MATCHES "${said_of}")
    message(FATAL_ERROR "${ARGN}: ${status}: ${said}")
  endif()
endfunction()
expect_refusal("ALLPAIRS_BUILD_APP needs ALLPAIRS_BUILD_SCENE" -D ALLPAIRS_BUILD_SCENE=OFF)
expect_refusal("ALLPAIRS_BUILD_BENCHMARKS needs ALLPAIRS_BUILD_PARALLEL" -D ALLPAIRS_BUILD_SCENE=ON -D ALLPAIRS_BUILD_PARALLEL=OFF
               -D ALLPAIRS_BUILD_APP=OFF -D ALLPAIRS_BUILD_C=OFF -D ALLPAIRS_BUILD_TESTS=OFF -D ALLPAIRS_BUILD_BENCHMARKS=ON)
