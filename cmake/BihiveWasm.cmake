# What the WebAssembly build needs instead of installed libraries. Header-only libraries are taken from the system
# through a private folder of links: with -I/usr/include the compiler would mix up the system's C library and its own.

set(BIHIVE_WASM_INCLUDE ${PROJECT_BINARY_DIR}/wasm_include)
file(MAKE_DIRECTORY ${BIHIVE_WASM_INCLUDE})
foreach(folder_and_package fmt:libfmt-dev nlohmann:nlohmann-json3-dev valijson:libvalijson-dev gemmi:gemmi-dev
                           tao:tao-pegtl-dev hwy:libhwy-dev)
  string(REPLACE ":" ";" folder_and_package ${folder_and_package})
  list(GET folder_and_package 0 folder)
  list(GET folder_and_package 1 package)
  if(NOT IS_DIRECTORY /usr/include/${folder})
    bihive_missing("The folder /usr/include/${folder}" ${package})
  endif()
  file(CREATE_LINK /usr/include/${folder} ${BIHIVE_WASM_INCLUDE}/${folder} SYMBOLIC)
endforeach()

add_library(bihive_wasm_libraries INTERFACE)
target_include_directories(bihive_wasm_libraries SYSTEM INTERFACE ${BIHIVE_WASM_INCLUDE})
target_compile_definitions(bihive_wasm_libraries INTERFACE FMT_HEADER_ONLY)
list(APPEND BIHIVE_LIBRARY_DEPENDENCIES $<BUILD_INTERFACE:bihive_wasm_libraries>)

# Exceptions: the header-only libraries throw, and the library turns that into errors. SIMD: every browser of the last
# years has it. Threads are workers with shared memory, which a page only has where its server sends certain headers.
option(BIHIVE_WASM_THREADS "Build WebAssembly for several threads" ON)
add_compile_options(-fexceptions -msimd128)
add_link_options(-fexceptions)
if(BIHIVE_WASM_THREADS)
  add_compile_options(-pthread)
  add_link_options(-pthread)
endif()

# Debian keeps the JavaScript modules that em++ needs for linking here.
if(IS_DIRECTORY /usr/share/nodejs)
  set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
endif()
