# What `cmake --install` puts down, and the package that find_package(Allpairs) reads.

include(CMakePackageConfigHelpers)

set(allpairs_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Allpairs")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/allpairs" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(
  EXPORT AllpairsTargets
  NAMESPACE allpairs::
  DESTINATION ${allpairs_package_dir})

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/AllpairsConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/AllpairsConfig.cmake" INSTALL_DESTINATION ${allpairs_package_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/AllpairsConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/AllpairsConfig.cmake" "${PROJECT_BINARY_DIR}/AllpairsConfigVersion.cmake"
        DESTINATION ${allpairs_package_dir})
