# cmake --install: the program, the library, its public headers (public_headers.txt), and the files that find_package(bihive)
# needs. Components are the packages that `make package` makes (BihivePackage.cmake). bindings/c and bindings/python
# install the library for C and the Python package.

include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/bihive)
# A shared library belongs to the programs' package, and its name for the linker to the developers'.
foreach(target_and_export bihive_rays:bihiveRaysTargets bihive_lib:bihivePicturesTargets)
  string(REPLACE ":" ";" target_and_export ${target_and_export})
  list(GET target_and_export 0 target)
  list(GET target_and_export 1 export)
  install(
    TARGETS ${target} EXPORT ${export}
    ARCHIVE COMPONENT libbihive-dev
    LIBRARY COMPONENT bihive NAMELINK_COMPONENT libbihive-dev)
  install(EXPORT ${export} NAMESPACE bihive:: DESTINATION ${config_folder} COMPONENT libbihive-dev)
  if(BUILD_SHARED_LIBS)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN")
  endif()
endforeach()
set(public_headers ${PROJECT_SOURCE_DIR}/cmake/public_headers.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${public_headers})
file(STRINGS ${public_headers} headers REGEX "^bihive/")
foreach(header ${headers})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder}
          COMPONENT libbihive-dev)
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/bihiveConfig.cmake.in ${PROJECT_BINARY_DIR}/bihiveConfig.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bihiveConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bihiveConfig.cmake ${PROJECT_BINARY_DIR}/bihiveConfigVersion.cmake
        DESTINATION ${config_folder} COMPONENT libbihive-dev)
include(BihivePkgConfig)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)
# The programs find a shared library of bihive, and the libraries that the portable archive brings along (lib/bihive),
# from where they stand, wherever the folder is moved. RPATH instead of RUNPATH, because it also counts for what those
# libraries need.
file(RELATIVE_PATH from_programs ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
foreach(program bihive bihive-mpi bihive-thesis bihive-view)
  if(TARGET ${program} AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
    set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/${from_programs};$ORIGIN/${from_programs}/bihive")
    target_link_options(${program} PRIVATE LINKER:--disable-new-dtags)
  endif()
endforeach()
if(TARGET bihive)
  install(TARGETS bihive bihive-thesis COMPONENT bihive)
  include(BihiveWords)
  # The page of `bihive web`, if `make web` has built it.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/build-web/page/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bihive/web COMPONENT bihive
          OPTIONAL)
endif()
if(TARGET bihive-mpi)
  # A cluster has an MPI of its own, so the packages leave it out: cmake --install build --component mpi.
  install(TARGETS bihive-mpi COMPONENT mpi EXCLUDE_FROM_ALL)
endif()
if(TARGET bihive-view)
  install(TARGETS bihive-view COMPONENT bihive)
  set(desktop ${PROJECT_SOURCE_DIR}/data/desktop)
  install(FILES ${desktop}/bihive.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT bihive)
  install(FILES ${desktop}/bihive-types.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT bihive)
  install(FILES ${desktop}/bihive.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT bihive)
endif()
