# Run by CPack over the files that are about to be packed: Debian's packages have manual pages and changelogs compressed.

set(share "${CPACK_TEMPORARY_DIRECTORY}/*${CPACK_PACKAGING_INSTALL_PREFIX}/share") # of each component
file(GLOB documents "${share}/man/man*/*.[1-9]" "${share}/doc/*/changelog")
foreach(document IN LISTS documents)
  execute_process(COMMAND gzip --best --no-name --force "${document}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
