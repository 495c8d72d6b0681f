# Run by cpack when the files of a package stand in CPACK_TEMPORARY_INSTALL_DIRECTORY, before they are packed.

if(CPACK_GENERATOR STREQUAL "DEB")
  include(${CPACK_BIHIVE_SOURCE}/cmake/package/finish_debian.cmake)
else()
  include(${CPACK_BIHIVE_SOURCE}/cmake/package/bring_libraries.cmake)
endif()
