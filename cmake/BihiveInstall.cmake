# cmake --install: the program, the library, its public headers (public_headers.txt), and the files that find_package(bihive)
# needs. bindings/c installs the library for C.

include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/bihive)
install(TARGETS bihive_lib EXPORT bihiveTargets)
set(public_headers ${PROJECT_SOURCE_DIR}/cmake/public_headers.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${public_headers})
file(STRINGS ${public_headers} headers REGEX "^bihive/")
foreach(header ${headers})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
endforeach()
install(EXPORT bihiveTargets NAMESPACE bihive:: DESTINATION ${config_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/bihiveConfig.cmake.in ${PROJECT_BINARY_DIR}/bihiveConfig.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bihiveConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bihiveConfig.cmake ${PROJECT_BINARY_DIR}/bihiveConfigVersion.cmake
        DESTINATION ${config_folder})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The programs find a shared library beside themselves, wherever the folder is moved.
if(BUILD_SHARED_LIBS)
  file(RELATIVE_PATH from_programs ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  foreach(program bihive bihive-view)
    if(TARGET ${program})
      set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/${from_programs}")
    endif()
  endforeach()
endif()
if(TARGET bihive)
  install(TARGETS bihive)
  # The page of `bihive web`, if `make web` has built it.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/build-web/page/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bihive/web OPTIONAL)
endif()
if(TARGET bihive-view)
  install(TARGETS bihive-view)
endif()
