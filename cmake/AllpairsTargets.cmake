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
set(allpairs_origin "$ORIGIN")
if(APPLE)
  set(allpairs_origin "@loader_path")
endif()
set(CMAKE_INSTALL_RPATH "${allpairs_origin};${allpairs_origin}/${allpairs_lib_from_bin}")

# The number behind .so, and that of Debian's packages of libraries: it goes up by one with a release that breaks programs
# linked with the one before, whatever the number of the release. That of C, which breaks less, is counted for itself.
set(ALLPAIRS_SOVERSION 0)
set(ALLPAIRS_C_SOVERSION 0)

# What is installed belongs to components, each of which is one package (AllpairsPackages.cmake): runtime (the command),
# python (the module), and of each part its shared library, and what else a program is built with. Parts that need what
# most users do without have components of their own. Those of mpi are in no package. Where nothing is said it is dev.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)

# Sets the two variables to the components of a part: that of its shared library, and that of all else.
function(allpairs_components_of part library_variable development_variable)
  set(components lib dev)
  if(part STREQUAL "c")
    set(components c dev)
  elseif(part STREQUAL "join")
    set(components scene scene_dev)
  elseif(part MATCHES "^(scene|fcl|bullet|mpi)$")
    set(components ${part} ${part}_dev)
  endif()
  list(GET components 0 first)
  list(GET components 1 second)
  set(${library_variable} ${first} PARENT_SCOPE)
  set(${development_variable} ${second} PARENT_SCOPE)
endfunction()

# What comes after in a folder of a preset that checks is hardly optimised, if at all: GCC takes two thirds of the time,
# Clang with AddressSanitizer one third. For tests, commands, readers and Python, whose own code is seldom what
# takes long.
macro(allpairs_compile_quickly)
  set(allpairs_quick -Og)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(allpairs_quick -O0)
  endif()
  string(REGEX REPLACE "-O[12]" "${allpairs_quick}" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")
endmacro()

# For vector kernels, tests and fuzz targets: without the checks of each access for what AddressSanitizer finds too, which Clang
# compiles in three fifths of the time.
set(allpairs_fewer_checks -fno-sanitize=null,alignment,object-size,pointer-overflow)

# Compiles one of our targets as C++20 with our warnings; without fused multiply-add, which would make the result depend
# on the instruction set; without the -ffast-math of a parent project, which loses pairs and lets a NaN pass; and without
# the path of the source tree in what is built. With AS_CXX17 as C++17, as programs of users may be.
function(allpairs_configure target)
  if("AS_CXX17" IN_LIST ARGN)
    set_target_properties(${target} PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
  else()
    target_compile_features(${target} PRIVATE cxx_std_20)
  endif()
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  if(MSVC)
    # Visual C++ fuses no multiply-add unless /fp:contract or /fp:fast asks for it.
    target_compile_options(${target} PRIVATE /W4 /permissive- /Zc:__cplusplus /utf-8 /fp:precise
                           $<$<CXX_COMPILER_ID:Clang>:/clang:-ffp-contract=off> $<$<BOOL:${ALLPAIRS_WARNINGS_AS_ERRORS}>:/WX>)
    target_compile_definitions(${target} PRIVATE NOMINMAX _CRT_SECURE_NO_WARNINGS)
    return()
  endif()
  target_compile_options(
    ${target}
    PRIVATE -fno-fast-math
            -fno-unsafe-math-optimizations
            -fno-finite-math-only
            -fno-associative-math
            -fno-reciprocal-math
            -fsigned-zeros
            -ffp-contract=off
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
            $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wno-subobject-linkage>)
  # Another project that names no type of build is not to get the engine unoptimised.
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O")
    target_compile_options(${target} BEFORE PRIVATE -O2)
  endif()
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
  target_compile_features(${target} INTERFACE cxx_std_17) # which is what our headers need
  set(soversion ${ALLPAIRS_SOVERSION})
  if(export_name STREQUAL "c")
    set(soversion ${ALLPAIRS_C_SOVERSION})
  endif()
  # Nothing marks what is exported: a parent that hides the rest would get libraries without a function.
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name} VERSION ${PROJECT_VERSION}
                                             SOVERSION ${soversion}
                                             CXX_VISIBILITY_PRESET default VISIBILITY_INLINES_HIDDEN OFF)
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                                              "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  if(ALLPAIRS_INSTALL)
    allpairs_components_of(${export_name} library development)
    install(
      TARGETS ${target}
      EXPORT Allpairs_${export_name}
      RUNTIME COMPONENT ${library}
      LIBRARY COMPONENT ${library} NAMELINK_COMPONENT ${development}
      ARCHIVE COMPONENT ${development})
    set_property(GLOBAL APPEND PROPERTY ALLPAIRS_COMPONENTS ${export_name})
  endif()
endfunction()

# Adds a library of ours that is headers only, known to users as allpairs::NAME, exported as the others are.
function(allpairs_add_interface target export_name)
  add_library(${target} INTERFACE)
  add_library(allpairs::${export_name} ALIAS ${target})
  target_compile_features(${target} INTERFACE cxx_std_17)
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

# Adds a GoogleTest program from the given sources; each TEST is a test of its own for ctest. With AS_CXX17 it is compiled as
# that, and the names of its tests begin so. ThreadSanitizer leaves out the sources behind ONE_THREAD, which tell it nothing:
# their tests begin no thread, and threads of programs that they run are those that tests of other sources run. Where THREADS
# is a filter, it leaves out the tests that this does not name too. Without other sources there is no program then.
function(allpairs_add_test target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "AS_CXX17" "THREADS" "SOURCES;ONE_THREAD;LIBRARIES")
  foreach(source IN LISTS ARG_ONE_THREAD)
    file(STRINGS ${source} threads REGEX "std::(j?thread|async)|pthread_create|TbbExecutor|PoolExecutor|ChangingExecutor")
    if(threads)
      message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${source} stands behind ONE_THREAD, and begins threads: ${threads}")
    endif()
  endforeach()
  if(NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")
    list(APPEND ARG_SOURCES ${ARG_ONE_THREAD})
  elseif(NOT ARG_SOURCES)
    return()
  endif()
  add_executable(${target} ${ARG_SOURCES})
  set(standard)
  set(discovery)
  if(ARG_AS_CXX17)
    set(standard AS_CXX17)
    list(APPEND discovery TEST_PREFIX cxx17.)
  endif()
  if(ARG_THREADS AND CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")
    list(APPEND discovery TEST_FILTER ${ARG_THREADS})
  endif()
  allpairs_configure(${target} ${standard})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${target} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  gtest_discover_tests(${target} WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" DISCOVERY_TIMEOUT 120 ${discovery})
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
