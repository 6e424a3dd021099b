# Debian packages of what is installed, by `cpack -G DEB` in the build folder or ./dev package: the engine, the library for
# C, the command, the Python module, and what needs Assimp, FCL or Bullet each for itself, so that nobody gets these who did
# not ask for them (docs/decisions/0032-packages.md).

# A Debian package names a maintainer to write to; the distributor sets it. example.org is nobody's (RFC 2606).
set(ALLPAIRS_PACKAGE_CONTACT "Allpairs developers <allpairs@example.org>"
    CACHE STRING "The maintainer that packages name: a name and an address")

set(CPACK_PACKAGE_NAME allpairs)
set(CPACK_PACKAGE_VENDOR Allpairs)
set(CPACK_PACKAGE_CONTACT "${ALLPAIRS_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has a summary of its own: the first line of its description
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/FinishDocuments.cmake")
set(CPACK_ALLPAIRS_SOURCE "${PROJECT_SOURCE_DIR}") # for that script
set(CPACK_ALLPAIRS_BUILD "${PROJECT_BINARY_DIR}")
set(CPACK_COMPONENTS_ALL)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON) # other packages' shlibdeps find our libraries
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS)
foreach(folder engine collision elements partition generate parallel scene join c)
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/src/${folder}")
endforeach()
list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/adapters/fcl"
     "${PROJECT_BINARY_DIR}/adapters/mpi" "${PROJECT_BINARY_DIR}/adapters/objects")
# The loader's cache learns of libraries by a trigger. CPack would write scripts that do it once more, unless the package has
# some of these names; files that don't exist it leaves out.
file(WRITE "${PROJECT_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
set(allpairs_control "${PROJECT_BINARY_DIR}/triggers" "${PROJECT_BINARY_DIR}/no-script/postinst"
    "${PROJECT_BINARY_DIR}/no-script/postrm")

# Of a package: its section, what it is, in a line and in a sentence, and what it depends on, beside the libraries that its
# files are linked with. OURS are packages of ours, by their components; those that are not made are left out.
macro(allpairs_package component name)
  cmake_parse_arguments(ARG "LIBRARY" "SECTION;SUMMARY;TEXT;RECOMMENDS" "OURS;DEPENDS" ${ARGN})
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(allpairs_name_of_${component} ${name})
  set(allpairs_depends ${ARG_DEPENDS})
  foreach(allpairs_needed IN LISTS ARG_OURS)
    if(allpairs_name_of_${allpairs_needed})
      list(APPEND allpairs_depends "${allpairs_name_of_${allpairs_needed}} (= ${PROJECT_VERSION})")
    endif()
  endforeach()
  list(JOIN allpairs_depends ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${ARG_SECTION})
  set(CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS "${ARG_RECOMMENDS}")
  # The first line is the summary; Debian wants lines short.
  set(CPACK_COMPONENT_${upper}_DESCRIPTION
      "exact broad-phase collision detection (${ARG_SUMMARY})\nOf n axis-aligned boxes, which overlap? Allpairs finds the pairs that the\ndouble loop over all pairs finds, in scenes, meshes and plain boxes.\n\n${ARG_TEXT}")
  if(ARG_LIBRARY)
    set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "${allpairs_control}")
  endif()
  # The licence asks for a copy of itself in all of them; what else Debian wants there is made when they are packed.
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright
          COMPONENT ${component})
endmacro()

# The libraries, which programs need to run. Those that are static are in the packages for development.
if(BUILD_SHARED_LIBS)
  allpairs_package(lib liballpairs${ALLPAIRS_SOVERSION} LIBRARY SECTION libs SUMMARY "engine"
                   TEXT "The engine, and the libraries that need nothing else but oneTBB.")
  if(TARGET allpairs_scene)
    allpairs_package(scene liballpairs-scene${ALLPAIRS_SOVERSION} LIBRARY SECTION libs SUMMARY "scene readers" OURS lib
                     TEXT "The readers of scenes and meshes, and joins of files of boxes.")
  endif()
  if(TARGET allpairs_fcl)
    allpairs_package(fcl liballpairs-fcl${ALLPAIRS_SOVERSION} LIBRARY SECTION libs SUMMARY "shapes by FCL" OURS lib
                     TEXT "The narrow phase on real shapes, by the Flexible Collision Library.")
  endif()
endif()
if(TARGET allpairs_c)
  allpairs_package(c liballpairs-c${ALLPAIRS_C_SOVERSION} LIBRARY SECTION libs SUMMARY "library for C" OURS lib
                   TEXT "The engine for C, and for languages that call C.")
endif()

# What programs are built with. Static libraries are linked with what they use, which is recommended then.
set(allpairs_for_engine)
set(allpairs_for_scene)
if(NOT BUILD_SHARED_LIBS)
  set(allpairs_for_engine "libtbb-dev")
  set(allpairs_for_scene "libassimp-dev, zlib1g-dev, libpugixml-dev, libfmt-dev, nlohmann-json3-dev")
endif()
allpairs_package(dev liballpairs-dev SECTION libdevel SUMMARY "headers" OURS lib c RECOMMENDS "${allpairs_for_engine}"
                 TEXT "Headers, libraries, and files for CMake and pkg-config, for C++ and C.")
if(TARGET allpairs_scene)
  allpairs_package(scene_dev liballpairs-scene-dev SECTION libdevel SUMMARY "headers of scene readers" OURS dev scene
                   RECOMMENDS "${allpairs_for_scene}"
                   TEXT "What programs are built with that read scenes and meshes with Allpairs.")
endif()
if(TARGET allpairs_fcl)
  allpairs_package(fcl_dev liballpairs-fcl-dev SECTION libdevel SUMMARY "headers for FCL" OURS dev fcl
                   DEPENDS libfcl-dev
                   TEXT "What programs are built with that use Allpairs together with FCL.")
endif()
if(TARGET allpairs_bullet)
  allpairs_package(bullet_dev liballpairs-bullet-dev SECTION libdevel SUMMARY "headers for Bullet" OURS dev
                   RECOMMENDS "libbullet-dev" # a user's Bullet may come from elsewhere
                   TEXT "Headers of a broad phase for Bullet's worlds.")
endif()

if(TARGET allpairs_app)
  allpairs_package(runtime allpairs SECTION science SUMMARY "command" OURS lib scene fcl
                   TEXT "The command allpairs, which reads scenes, meshes and arrays of boxes.")
endif()
if(TARGET allpairs_python)
  math(EXPR allpairs_next_python "${ALLPAIRS_PYTHON_MINOR} + 1")
  allpairs_package(python python3-allpairs SECTION python SUMMARY "Python 3" OURS lib scene
                   DEPENDS "python3 (>= 3.${ALLPAIRS_PYTHON_MINOR})" "python3 (<< 3.${allpairs_next_python})" python3-numpy
                   TEXT "The module for Python 3 and NumPy.")
endif()

include(CPack)
