# The archive runs on a Linux that has none of the libraries: those that the programs need stand in lib/bihive, each with
# its licence. Not those that belong to a system and its drivers: the C and C++ libraries, X, Wayland and OpenGL.

set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
file(GLOB programs ${root}/bin/*)
file(
  GET_RUNTIME_DEPENDENCIES
  EXECUTABLES ${programs}
  RESOLVED_DEPENDENCIES_VAR libraries
  UNRESOLVED_DEPENDENCIES_VAR missing
  PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so" "^lib(X|x|GL|EGL|wayland|bihive)"
  DIRECTORIES ${root}/lib)
if(missing)
  message(FATAL_ERROR "The archive would lack ${missing}, which the programs need")
endif()
foreach(library ${libraries})
  file(INSTALL ${library} DESTINATION ${root}/lib/bihive FOLLOW_SYMLINK_CHAIN)
  # A package names its file below /lib or below /usr/lib, which are one folder on a merged system.
  file(REAL_PATH ${library} file)
  string(REGEX REPLACE "^/usr" "" short_name ${file})
  execute_process(COMMAND dpkg-query -S /usr${short_name} ${short_name} OUTPUT_VARIABLE owner ERROR_QUIET)
  string(REGEX REPLACE ":.*" "" owner "${owner}")
  if(owner AND EXISTS /usr/share/doc/${owner}/copyright)
    file(MAKE_DIRECTORY ${root}/share/doc/bihive/libraries)
    file(COPY_FILE /usr/share/doc/${owner}/copyright ${root}/share/doc/bihive/libraries/${owner})
  else()
    message(FATAL_ERROR "Nobody knows the licence of ${library}: the archive cannot bring it along")
  endif()
endforeach()
