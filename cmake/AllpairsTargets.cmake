# How every target of the project is made: the standard, the warnings, the place of its output.

# As a part of another project, ours stays out of the way: the parent decides where programs go.
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release)
  endif()
endif()

# The installed tree can be moved: programs and libraries find ours beside them.
file(RELATIVE_PATH allpairs_lib_from_bin "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON) # in the build folder too, whose name would leave its length behind
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/${allpairs_lib_from_bin}")

# What is installed belongs to one of four: runtime (the command and shared libraries), dev (what else a program is built
# with), python (the module), mpi (the program and the module for several machines, which are in no package). Where nothing is said it is dev.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)

# Compiles one of our targets as C++20 with our warnings; without fused multiply-add, which would make the result depend
# on the instruction set; and without the path of the source tree in what is built.
function(allpairs_configure target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(
    ${target}
    PRIVATE -ffp-contract=off
            -fmacro-prefix-map=${PROJECT_SOURCE_DIR}=.
            -fdebug-prefix-map=${PROJECT_SOURCE_DIR}=.
            -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wconversion
            -Wsign-conversion
            -Wnon-virtual-dtor
            -Wold-style-cast
            -Woverloaded-virtual
            -Wcast-qual
            -Wdouble-promotion
            # Tests of lanes are joined without branches on purpose.
            $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>
            # GCC 12 sees overlaps in plain std::string additions at -O3 (GCC bug 105651).
            $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
            # In a unity build GCC takes our sources for headers, whose types with members of unnamed namespaces it warns of.
            $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>)
  if(ALLPAIRS_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# Adds a library of ours from the given sources, known to users as allpairs::NAME, in an export set of its own, so that
# find_package(Allpairs COMPONENTS NAME) asks for nothing that the others need.
function(allpairs_add_library target export_name)
  add_library(${target} ${ARGN})
  add_library(allpairs::${export_name} ALIAS ${target})
  allpairs_configure(${target})
  set_target_properties(
    ${target} PROPERTIES EXPORT_NAME ${export_name} VERSION ${PROJECT_VERSION}
                         SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                                              "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  if(ALLPAIRS_INSTALL)
    install(
      TARGETS ${target}
      EXPORT Allpairs_${export_name}
      LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev)
    set_property(GLOBAL APPEND PROPERTY ALLPAIRS_COMPONENTS ${export_name})
  endif()
endfunction()

# Adds a library of ours that is headers only, known to users as allpairs::NAME, exported as the others are.
function(allpairs_add_interface target export_name)
  add_library(${target} INTERFACE)
  add_library(allpairs::${export_name} ALIAS ${target})
  target_compile_features(${target} INTERFACE cxx_std_20)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
  target_include_directories(${target} INTERFACE "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  if(ALLPAIRS_INSTALL)
    install(TARGETS ${target} EXPORT Allpairs_${export_name})
    set_property(GLOBAL APPEND PROPERTY ALLPAIRS_COMPONENTS ${export_name})
  endif()
endfunction()

# Compiles a C program of ours as C11 with our warnings.
function(allpairs_configure_c target)
  set_target_properties(${target} PROPERTIES C_STANDARD 11 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion)
  if(ALLPAIRS_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# Adds a GoogleTest program from the given sources; each TEST is a test of its own for ctest.
function(allpairs_add_test target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "SOURCES;LIBRARIES")
  add_executable(${target} ${ARG_SOURCES})
  allpairs_configure(${target})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${target} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${target} WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" DISCOVERY_TIMEOUT 120)
endfunction()

# Adds a program of one page, NAME.cpp or SOURCE, that is run as a test: it must succeed and print exactly what is in
# the file EXPECTED (NAME.expected beside it).
function(allpairs_add_example name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "EXPECTED;SOURCE" "LIBRARIES")
  if(NOT ARG_SOURCE)
    set(ARG_SOURCE ${name}.cpp)
  endif()
  add_executable(example_${name} ${ARG_SOURCE})
  if(ARG_SOURCE MATCHES "\\.c$")
    allpairs_configure_c(example_${name})
  else()
    allpairs_configure(example_${name})
  endif()
  target_link_libraries(example_${name} PRIVATE ${ARG_LIBRARIES})
  if(NOT ARG_EXPECTED)
    set(ARG_EXPECTED "${CMAKE_CURRENT_SOURCE_DIR}/${name}.expected")
  endif()
  if(ALLPAIRS_BUILD_TESTS)
    add_test(NAME examples.${name} COMMAND "${PROJECT_SOURCE_DIR}/scripts/expect-output" "${ARG_EXPECTED}"
                                           $<TARGET_FILE:example_${name}>)
  endif()
endfunction()
