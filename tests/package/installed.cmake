# Installs the build to a prefix, moves it, and uses it there: all of it, and the engine alone on a system that has
# nothing that the other parts need.

include(${CMAKE_CURRENT_LIST_DIR}/Steps.cmake)
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${ALLPAIRS_BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/moved)

# No installed file knows where it was built.
file(GLOB_RECURSE installed ${WORK}/moved/*)
if(NOT installed)
  message(FATAL_ERROR "nothing was installed")
endif()
foreach(path IN ITEMS ${WORK}/first/ ${ALLPAIRS_SOURCE}/)
  foreach(file IN LISTS installed)
    execute_process(COMMAND grep --quiet --fixed-strings --text ${path} ${file} RESULT_VARIABLE result)
    if(NOT result EQUAL 1)
      message(FATAL_ERROR "${file} names ${path}")
    endif()
  endforeach()
endforeach()

set(found -D CMAKE_PREFIX_PATH=${WORK}/moved)
configure_consumer(${WORK}/all ${found} -D PARTS=${COMPONENTS})
build_and_run(${WORK}/all)

# A C++17 program of the other compiler, too.
find_program(CLANG NAMES clang++-16 clang++)
if(CLANG AND NOT COMPILER MATCHES "clang" AND NOT FLAGS MATCHES "--coverage")
  set(with_cxx17 engine)
  foreach(part IN ITEMS bullet c fcl)
    if(COMPONENTS MATCHES "(^|,)${part}(,|$)")
      string(APPEND with_cxx17 ",${part}")
    endif()
  endforeach()
  configure_consumer(${WORK}/clang ${found} -D PARTS=${with_cxx17} -D CMAKE_CXX_COMPILER=${CLANG})
  build_and_run(${WORK}/clang)
endif()

set(bare)
foreach(package IN ITEMS TBB assimp pugixml fmt nlohmann_json CLI11)
  list(APPEND bare -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
configure_consumer(${WORK}/engine ${found} ${bare} -D PARTS=engine)
build_and_run(${WORK}/engine)
configure_consumer(${WORK}/default ${found} ${bare} -D PARTS=none)

# A project's own oneTBB is taken, and a part that was not loaded is not there.
file(WRITE ${WORK}/own/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(Own LANGUAGES CXX)
add_library(TBB::tbb INTERFACE IMPORTED)
find_package(Allpairs REQUIRED COMPONENTS \${PARTS})
if(Allpairs_engine_FOUND AND NOT TARGET allpairs::allpairs)
  message(FATAL_ERROR \"the engine is said to be there, and is not\")
endif()
")
foreach(part IN ITEMS c parallel)
  if(COMPONENTS MATCHES "(^|,)${part}(,|$)")
    run(${CMAKE_COMMAND} -S ${WORK}/own -B ${WORK}/own/${part} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER} ${found} ${bare}
        -D PARTS=${part})
  endif()
endforeach()

# A part that is not there is an error that names it.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/unknown -G ${GENERATOR} -D PARTS=submarine
                        -D CMAKE_CXX_COMPILER=${COMPILER} ${found} RESULT_VARIABLE result ERROR_VARIABLE output
                        OUTPUT_QUIET)
string(REGEX REPLACE "[ \n]+" " " output "${output}")
if(result EQUAL 0 OR NOT output MATCHES "the component submarine does not exist; this package has: engine,")
  message(FATAL_ERROR "asking for an unknown component: ${result}\n${output}")
endif()

# The program runs from where it was moved to.
if(APP)
  run(${WORK}/moved/bin/allpairs --help)
endif()
