# What Debian's rules ask of a package beyond the files that are installed: packed manual pages and changelogs, a
# copyright file, completions in Debian's folder for zsh, and programs that look for libraries in the usual places only.

function(pack file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(strip file)
  execute_process(COMMAND strip ${ARGN} --remove-section=.comment --remove-section=.note ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The day of the commit, as scripts/package says, so that the same commit gives the same package.
set(date_of_now "")
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  set(date_of_now "--date=@$ENV{SOURCE_DATE_EPOCH}")
endif()
execute_process(COMMAND date -u -R ${date_of_now} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)

# The text of a licence from `begin` on, as copyright files write it: indented, a point on an empty line.
function(read_license file begin result)
  file(READ ${file} text)
  string(FIND "${text}" "${begin}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${file} does not hold \"${begin}\"")
  endif()
  string(SUBSTRING "${text}" ${place} -1 text)
  string(REGEX REPLACE "\n\n+" "\n.\n" text "${text}")
  string(REGEX REPLACE "\n" "\n " text "${text}")
  string(STRIP "${text}" text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()
read_license(${CPACK_BIHIVE_SOURCE}/LICENSE "Permission is hereby" license)
read_license(${CPACK_BIHIVE_SOURCE}/data/font/LICENSE "Copyright (c) 2003 by Bitstream" font_license)

foreach(component ${CPACK_COMPONENTS_ALL})
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(documents ${root}/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  configure_file(${CPACK_BIHIVE_SOURCE}/cmake/package/copyright.in ${documents}/copyright @ONLY)
  file(COPY_FILE ${CPACK_BIHIVE_SOURCE}/CHANGELOG.md ${documents}/changelog)
  pack(${documents}/changelog)
  file(WRITE ${documents}/changelog.Debian
"bihive (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) bookworm; urgency=medium

  * Made by cpack from the sources; changelog.gz says what is new.

 -- ${CPACK_BIHIVE_MAINTAINER}  ${date}
")
  pack(${documents}/changelog.Debian)
  file(GLOB pages ${root}/share/man/man1/*.1)
  foreach(page ${pages})
    pack(${page})
  endforeach()
  if(EXISTS ${root}/share/zsh/site-functions)
    file(RENAME ${root}/share/zsh/site-functions ${root}/share/zsh/vendor-completions)
  endif()
  foreach(program bihive bihive-thesis bihive-view)
    if(EXISTS ${root}/bin/${program} AND NOT EXISTS ${root}/lib/libbihive.so.${CPACK_PACKAGE_VERSION})
      file(RPATH_REMOVE FILE ${root}/bin/${program})
    endif()
    if(EXISTS ${root}/bin/${program})
      strip(${root}/bin/${program})
    endif()
  endforeach()
  file(GLOB archives ${root}/lib/*.a)
  foreach(archive ${archives})
    strip(${archive} --strip-debug)
  endforeach()
  # pkg-config looks for it in the folder of the architecture, also when it serves another machine's compiler.
  if(EXISTS ${root}/lib/pkgconfig)
    execute_process(COMMAND dpkg-architecture -qDEB_HOST_MULTIARCH OUTPUT_VARIABLE architecture
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    file(GLOB descriptions ${root}/lib/pkgconfig/*.pc)
    foreach(description ${descriptions})
      cmake_path(GET description FILENAME name)
      file(READ ${description} pc)
      string(REPLACE "prefix=\${pcfiledir}/" "prefix=\${pcfiledir}/../" pc "${pc}")
      file(WRITE ${root}/lib/${architecture}/pkgconfig/${name} "${pc}")
    endforeach()
    file(REMOVE_RECURSE ${root}/lib/pkgconfig)
  endif()
  file(GLOB overrides ${CPACK_BIHIVE_SOURCE}/cmake/package/${package}.lintian-overrides)
  if(overrides)
    file(MAKE_DIRECTORY ${root}/share/lintian/overrides)
    file(COPY_FILE ${overrides} ${root}/share/lintian/overrides/${package})
  endif()
endforeach()
