# Read by cpack for each kind of package: Debian packages leave LICENSE out, because they have a copyright file.
if(CPACK_GENERATOR STREQUAL "DEB")
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL license Unspecified mpi)
endif()
