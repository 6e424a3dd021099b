# What `cmake --install` puts down, and the package that find_package(Allpairs) reads.

include(CMakePackageConfigHelpers)

set(allpairs_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Allpairs")
get_property(allpairs_components GLOBAL PROPERTY ALLPAIRS_COMPONENTS)

# Headers go with the library that implements them, so that a part that was not built has none.
foreach(component IN LISTS allpairs_components)
  allpairs_components_of(${component} library development)
  if(component STREQUAL "allpairs")
    file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/allpairs/*.h")
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/allpairs COMPONENT ${development})
  elseif(EXISTS "${PROJECT_SOURCE_DIR}/adapters/${component}/include")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/adapters/${component}/include/allpairs"
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${development})
  elseif(component STREQUAL "c")
    install(FILES "${PROJECT_SOURCE_DIR}/include/allpairs.h" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
            COMPONENT ${development})
  else()
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/allpairs/${component}"
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/allpairs COMPONENT ${development})
  endif()
endforeach()

# Reads from what a library links which components of ours it stands on (NEEDS) and which packages of others its
# installed target refers to (PACKAGES). A static library passes what it links privately on to whoever links it; a
# shared one keeps that to itself; among static ones, that of C does.
function(allpairs_read_links component)
  set(needs)
  set(packages)
  get_target_property(type allpairs::${component} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    get_target_property(links allpairs::${component} INTERFACE_LINK_LIBRARIES)
  else()
    get_target_property(links allpairs::${component} LINK_LIBRARIES)
  endif()
  if(type STREQUAL "SHARED_LIBRARY" AND NOT BUILD_SHARED_LIBS)
    set(links) # the library for C holds what it links
  endif()
  foreach(link IN LISTS links)
    if(link MATCHES "^allpairs(::|_)(.+)$")
      list(APPEND needs ${CMAKE_MATCH_2})
    elseif(link STREQUAL "allpairs")
      list(APPEND needs allpairs)
    elseif(link STREQUAL "fcl") # a target without a namespace, which our header refers to
      list(APPEND packages fcl)
    elseif(link MATCHES "^([A-Za-z_]+)::" AND NOT BUILD_SHARED_LIBS)
      string(REGEX REPLACE "^hwy$" "HWY" package ${CMAKE_MATCH_1}) # found as HWY, named hwy::
      list(APPEND packages ${package})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES packages)
  string(APPEND allpairs_links "set(_allpairs_needs_${component} ${needs})\n"
         "set(_allpairs_packages_${component} ${packages})\n")
  set(allpairs_links "${allpairs_links}" PARENT_SCOPE)
  set(allpairs_needs ${needs} PARENT_SCOPE)
  set(allpairs_packages ${packages} PARENT_SCOPE)
endfunction()

# Installs the pkg-config file of a component: allpairs.pc for the engine, allpairs-NAME.pc for another. It finds its
# prefix by where it lies, so that it can be moved with the rest.
function(allpairs_install_pkg_config component needs packages)
  set(folder "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_LIBDIR BASE_DIRECTORY "${folder}" OUTPUT_VARIABLE lib)
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_INCLUDEDIR BASE_DIRECTORY "${folder}" OUTPUT_VARIABLE include)
  if(component STREQUAL "allpairs")
    set(name allpairs)
    set(library allpairs)
  else()
    set(name allpairs-${component})
    set(library allpairs_${component})
  endif()
  set(libs "-L\${libdir} -l${library}")
  get_target_property(type allpairs::${component} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY") # headers only: there is nothing of its own to link
    set(libs)
  endif()
  set(cflags)
  if(component STREQUAL "mpi") # we call C's functions: without MPI's own for C++, mpi.pc names all libraries that it takes
    set(cflags " -DOMPI_SKIP_MPICXX -DMPICH_SKIP_MPICXX")
  endif()
  if("fcl" IN_LIST packages) # fcl.pc asks for C++11 behind what a program asks for: what it stands on, without that
    list(REMOVE_ITEM packages fcl)
    list(APPEND packages ccd eigen3 octomap)
    string(APPEND libs " -lfcl")
  endif()
  list(TRANSFORM needs PREPEND "allpairs-")
  list(TRANSFORM needs REPLACE "^allpairs-allpairs$" "allpairs")
  list(TRANSFORM packages TOLOWER)
  list(TRANSFORM packages REPLACE "^hwy$" "libhwy")
  list(JOIN needs " " needs)
  list(JOIN packages " " packages)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/allpairs.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
  allpairs_components_of(${component} library development)
  install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${folder}" COMPONENT ${development})
endfunction()

set(allpairs_links)
foreach(component IN LISTS allpairs_components)
  allpairs_components_of(${component} library development)
  install(
    EXPORT Allpairs_${component}
    NAMESPACE allpairs::
    DESTINATION ${allpairs_package_dir}
    COMPONENT ${development})
  allpairs_read_links(${component})
  allpairs_install_pkg_config(${component} "${allpairs_needs}" "${allpairs_packages}")
endforeach()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/AllpairsConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/AllpairsConfig.cmake" INSTALL_DESTINATION ${allpairs_package_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/AllpairsConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/AllpairsConfig.cmake" "${PROJECT_BINARY_DIR}/AllpairsConfigVersion.cmake"
        DESTINATION ${allpairs_package_dir})

if(PROJECT_IS_TOP_LEVEL) # what a parent packs is its own affair
  include(AllpairsPackages)
endif()
