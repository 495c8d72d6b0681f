# bihive_hide_internals(target): a shared library shows only what exported_symbols.map.in names. A static one is left as
# it is.
function(bihive_hide_internals target)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "SHARED_LIBRARY" OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
    return()
  endif()
  set(map ${PROJECT_BINARY_DIR}/exported_symbols.map)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/exported_symbols.map.in ${map} @ONLY)
  target_link_options(${target} PRIVATE LINKER:--version-script=${map})
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${map})
endfunction()
