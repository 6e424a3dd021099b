# Run by CPack over the files that are about to be packed: each package gets a bill of materials (SPDX) and a changelog in
# Debian's form, which wants manual pages and changelogs compressed. SOURCE_DATE_EPOCH, where it is set, is their date.

set(share "${CPACK_TEMPORARY_DIRECTORY}/*${CPACK_PACKAGING_INSTALL_PREFIX}/share") # of each component
file(GLOB folders "${share}/doc/*")
string(TIMESTAMP allpairs_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(folder IN LISTS folders)
  cmake_path(GET folder FILENAME package)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/changelog.in" "${folder}/changelog" @ONLY)
  string(REGEX REPLACE "/share/doc/[^/]*$" "" root "${folder}")
  execute_process(
    COMMAND "${CPACK_ALLPAIRS_SOURCE}/scripts/make-sbom" ${package} ${CPACK_PACKAGE_VERSION} "${root}" "${CPACK_ALLPAIRS_BUILD}"
    OUTPUT_FILE "${folder}/sbom.spdx.json" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB documents "${share}/man/man*/*.[1-9]" "${share}/doc/*/changelog")
foreach(document IN LISTS documents)
  execute_process(COMMAND gzip --best --no-name --force "${document}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
