# Debian packages of what is installed, by `cpack -G DEB` in the build folder or ./dev package: allpairs (the command and
# shared libraries), liballpairs-dev, python3-allpairs.

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
set(CPACK_COMPONENTS_ALL dev)
set(allpairs_packages liballpairs-dev)
if(TARGET allpairs_app OR TARGET allpairs_c OR BUILD_SHARED_LIBS)
  list(APPEND CPACK_COMPONENTS_ALL runtime)
  list(APPEND allpairs_packages allpairs)
endif()
if(TARGET allpairs_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND allpairs_packages python3-allpairs)
endif()

# The licence asks for a copy of itself in all of them; what else Debian wants in that folder is made when they are packed.
foreach(component package IN ZIP_LISTS CPACK_COMPONENTS_ALL allpairs_packages)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
          COMPONENT ${component})
endforeach()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/src/engine" "${PROJECT_BINARY_DIR}/src/collision"
    "${PROJECT_BINARY_DIR}/src/elements" "${PROJECT_BINARY_DIR}/src/parallel" "${PROJECT_BINARY_DIR}/src/scene" "${PROJECT_BINARY_DIR}/src/generate"
    "${PROJECT_BINARY_DIR}/src/partition" "${PROJECT_BINARY_DIR}/src/join")

# Other packages' shlibdeps find our libraries, and the loader's cache learns of them.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
file(WRITE "${PROJECT_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_BINARY_DIR}/triggers")

# The first line is the summary; Debian wants both short.
set(allpairs_description
    "Of n axis-aligned boxes, which overlap? Allpairs finds the pairs that the\ndouble loop over all pairs finds, in scenes, meshes and plain boxes.\n")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME allpairs)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "exact broad-phase collision detection\n${allpairs_description}\nThe command allpairs and the shared libraries.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME liballpairs-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION
    "exact broad-phase collision detection (headers)\n${allpairs_description}\nHeaders, libraries, and files for CMake and pkg-config.")
if("runtime" IN_LIST CPACK_COMPONENTS_ALL)
  set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "allpairs (= ${PROJECT_VERSION})")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libbullet-dev, libfcl-dev") # what the adapters are for
if(NOT BUILD_SHARED_LIBS) # static libraries are linked with what they use
  set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS
      "libhwy-dev, libtbb-dev, libassimp-dev, zlib1g-dev, libpugixml-dev, libfmt-dev, nlohmann-json3-dev")
endif()

if(TARGET allpairs_python)
  math(EXPR allpairs_next_python "${ALLPAIRS_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-allpairs)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "exact broad-phase collision detection (Python 3)\n${allpairs_description}\nThe module for Python 3 and NumPy.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${ALLPAIRS_PYTHON_MINOR}), python3 (<< 3.${allpairs_next_python}), python3-numpy")
  if(BUILD_SHARED_LIBS)
    string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", allpairs (= ${PROJECT_VERSION})")
  endif()
endif()

include(CPack)
