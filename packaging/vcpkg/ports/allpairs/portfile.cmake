set(VCPKG_POLICY_DLLS_IN_STATIC_LIBRARY enabled) # the library for C is always shared, and holds what it needs

vcpkg_download_distfile(
    ARCHIVE
    URLS "https://example.org/allpairs/allpairs-0.1.0.tar.gz"
    FILENAME "allpairs-0.1.0.tar.gz"
    SHA512 00000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000
)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${ARCHIVE}")

vcpkg_check_features(
    OUT_FEATURE_OPTIONS FEATURE_OPTIONS
    FEATURES
        c           ALLPAIRS_BUILD_C
        fcl         ALLPAIRS_FCL
        parallel    ALLPAIRS_BUILD_PARALLEL
        scene       ALLPAIRS_BUILD_SCENE
)

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${FEATURE_OPTIONS}
        -DALLPAIRS_BULLET=ON
        -DALLPAIRS_MPI=OFF
        -DALLPAIRS_SOFA=OFF
        -DALLPAIRS_BUILD_APP=OFF
        -DALLPAIRS_BUILD_TESTS=OFF
        -DALLPAIRS_BUILD_EXAMPLES=OFF
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME Allpairs CONFIG_PATH lib/cmake/Allpairs)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
