# `cpack` (make package): Debian packages, one a component, and an archive for any Linux. What is installed belongs to one
# of these components:
#   bihive          the programs, the page, manual pages, completions, desktop files
#   libbihive-c     the library for C; its package has the version of the soname: libbihive-cMAJOR.MINOR
#   libbihive-dev   the library, its headers, bihive.h, CMake and pkg-config files
#   python          the Python package, where it is built: python3-bihive
#   license         LICENSE, for plain installations and the archive; Debian packages have a copyright file of their own

set(BIHIVE_PACKAGE_MAINTAINER "bihive authors <bihive@bihive.invalid>" CACHE STRING "Who answers for the Debian packages: Name <address>")

set(CPACK_PACKAGE_NAME bihive)
set(CPACK_PACKAGE_VENDOR "bihive authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "ray tracer for spheres: molecules, particles, points")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package/finish.cmake)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package/choose_components.cmake)
# For these scripts.
set(CPACK_BIHIVE_SOURCE ${PROJECT_SOURCE_DIR})

# The archive: everything in one.
set(CPACK_ARCHIVE_COMPONENT_INSTALL OFF)
set(CPACK_SYSTEM_NAME ${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})

# Debian packages.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${BIHIVE_PACKAGE_MAINTAINER})
set(CPACK_BIHIVE_MAINTAINER ${BIHIVE_PACKAGE_MAINTAINER})
set(CPACK_DEBIAN_BIHIVE_PACKAGE_NAME bihive)
set(CPACK_DEBIAN_BIHIVE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_BIHIVE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_BIHIVE_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_DEBIAN_BIHIVE_PACKAGE_SUGGESTS "ffmpeg, libhdf5-103-1")
set(CPACK_COMPONENT_BIHIVE_DESCRIPTION
    "bihive draws molecules, particle simulations and point sets: pictures, films,
a window that turns them, and a page for the browser. It reads the files of
structural biology, materials science and simulation, and it measures and
draws the trees behind its pictures. Double precision decides every hit, and
every machine computes the same bits.")
set(CPACK_DEBIAN_LIBBIHIVE-DEV_PACKAGE_NAME libbihive-dev)
set(CPACK_DEBIAN_LIBBIHIVE-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBBIHIVE-DEV_PACKAGE_SHLIBDEPS OFF)
set(needed libfmt-dev libhwy-dev libpng-dev zlib1g-dev)
if(NOT BIHIVE_OWN_POOL)
  list(APPEND needed libtbb-dev)
endif()
if(BIHIVE_HAS_OPENEXR)
  list(APPEND needed libopenexr-dev)
endif()
if(BIHIVE_HAS_TIFF)
  list(APPEND needed libtiff-dev)
endif()
if(BIHIVE_HAS_FREETYPE)
  list(APPEND needed libfreetype-dev)
endif()
if("zstd" IN_LIST BIHIVE_LIBRARY_DEPENDENCIES)
  list(APPEND needed libzstd-dev)
endif()
if("lzma" IN_LIST BIHIVE_LIBRARY_DEPENDENCIES)
  list(APPEND needed liblzma-dev)
endif()
if("bz2" IN_LIST BIHIVE_LIBRARY_DEPENDENCIES)
  list(APPEND needed libbz2-dev)
endif()
if(BUILD_SHARED_LIBS)
  list(APPEND needed "bihive (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
endif()
if(TARGET bihive_c)
  # Versions of another soname are installed beside each other.
  set(soname_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  set(CPACK_DEBIAN_LIBBIHIVE-C_PACKAGE_NAME libbihive-c${soname_version})
  set(CPACK_DEBIAN_LIBBIHIVE-C_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_LIBBIHIVE-C_PACKAGE_SHLIBDEPS ON)
  # By which packages of programs that link it know what they need.
  set(shlibs ${PROJECT_BINARY_DIR}/libbihive-c/shlibs)
  file(WRITE ${shlibs} "libbihive_c ${soname_version} libbihive-c${soname_version} (>= ${PROJECT_VERSION})\n")
  set(CPACK_DEBIAN_LIBBIHIVE-C_PACKAGE_CONTROL_EXTRA ${shlibs})
  set(CPACK_COMPONENT_LIBBIHIVE-C_DESCRIPTION
      "The library behind bihive for C and languages that call C: rays and points
among spheres, and pictures. It has all that it needs inside and shows the
functions of bihive.h alone.")
  list(APPEND needed "libbihive-c${soname_version} (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
endif()
list(JOIN needed ", " CPACK_DEBIAN_LIBBIHIVE-DEV_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_LIBBIHIVE-DEV_DESCRIPTION
    "The C++ library behind bihive: closest hits, shadow rays and all hits of rays
among spheres, readers of molecules and particles, and pictures. This package
holds the library, its headers, and the files by which CMake and pkg-config
find it.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-bihive)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/package/python/postinst"
                                               "${PROJECT_SOURCE_DIR}/cmake/package/python/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "The Python package bihive: arrays of NumPy in, pictures and hits of rays out.
It reads the files of structural biology, materials science and simulation,
takes atoms of ASE and MDAnalysis, and makes films of trajectories. Its answers
have the bits of the program's.")
include(CPack)
