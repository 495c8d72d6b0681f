# The replacement for installed libraries in builds of WebAssembly and for other machines. Header-only libraries are
# taken from this system through a private folder of links: with -I/usr/include the compiler would mix the system's C
# library with its own.

set(BIHIVE_BARE_INCLUDE ${PROJECT_BINARY_DIR}/bare_include)
file(MAKE_DIRECTORY ${BIHIVE_BARE_INCLUDE})
set(folders fmt:libfmt-dev nlohmann:nlohmann-json3-dev gemmi:gemmi-dev tao:tao-pegtl-dev
            hwy:libhwy-dev)
if(NOT EMSCRIPTEN)
  list(APPEND folders GLES3:libgles-dev KHR:libgl-dev)
endif()
foreach(folder_and_package ${folders})
  string(REPLACE ":" ";" folder_and_package ${folder_and_package})
  list(GET folder_and_package 0 folder)
  list(GET folder_and_package 1 package)
  if(NOT IS_DIRECTORY /usr/include/${folder})
    bihive_missing("The folder /usr/include/${folder}" ${package})
  endif()
  file(CREATE_LINK /usr/include/${folder} ${BIHIVE_BARE_INCLUDE}/${folder} SYMBOLIC)
endforeach()

add_library(bihive_bare_libraries INTERFACE)
target_include_directories(bihive_bare_libraries SYSTEM INTERFACE ${BIHIVE_BARE_INCLUDE})
target_compile_definitions(bihive_bare_libraries INTERFACE FMT_HEADER_ONLY)
list(APPEND BIHIVE_RAYS_DEPENDENCIES $<BUILD_INTERFACE:bihive_bare_libraries>)
list(APPEND BIHIVE_LIBRARY_DEPENDENCIES $<BUILD_INTERFACE:bihive_bare_libraries>)
