# The libraries that bihive needs. Sets BIHIVE_LIBRARY_DEPENDENCIES and BIHIVE_CLI_DEPENDENCIES.

# Stops with a message that says which package to install.
function(bihive_missing what debian_package)
  message(FATAL_ERROR "${what} was not found. On Debian or Ubuntu: apt-get install ${debian_package}, "
                      "or scripts/setup demo for everything that the program needs.")
endfunction()

# Finds a package that has a CMake configuration.
macro(bihive_require package debian_package)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    bihive_missing("${package}" ${debian_package})
  endif()
endmacro()

# Finds a header-only library by one of its headers.
function(bihive_require_header header debian_package)
  string(MAKE_C_IDENTIFIER "BIHIVE_FOLDER_OF_${header}" variable)
  find_path(${variable} ${header})
  mark_as_advanced(${variable})
  if(NOT ${variable})
    bihive_missing("The header ${header}" ${debian_package})
  endif()
endfunction()

# Header-only libraries are never linked to an installed bihive: only its build needs them.
set(BIHIVE_LIBRARY_DEPENDENCIES "")
set(BIHIVE_CLI_DEPENDENCIES "")

if(EMSCRIPTEN)
  include(BihiveBare)
  include(BihiveWasm)
  return()
endif()

set(THREADS_PREFER_PTHREAD_FLAG ON)
bihive_require(Threads libc6-dev)
list(APPEND BIHIVE_LIBRARY_DEPENDENCIES Threads::Threads)
if(BIHIVE_BARE)
  include(BihiveBare)
  return()
endif()
if(NOT BIHIVE_OWN_POOL)
  bihive_require(TBB libtbb-dev)
  list(APPEND BIHIVE_LIBRARY_DEPENDENCIES TBB::tbb)
endif()
bihive_require(PNG libpng-dev)
bihive_require(ZLIB zlib1g-dev)
bihive_require(fmt libfmt-dev)
bihive_require(hwy libhwy-dev)
list(APPEND BIHIVE_LIBRARY_DEPENDENCIES PNG::PNG ZLIB::ZLIB fmt::fmt hwy::hwy)
bihive_require(nlohmann_json nlohmann-json3-dev)
list(APPEND BIHIVE_LIBRARY_DEPENDENCIES $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
# Headers alone: the program looks for EGL and OpenGL ES only when it needs them.
bihive_require_header(EGL/egl.h libegl-dev)
bihive_require_header(GLES3/gl3.h libgles-dev)
list(APPEND BIHIVE_LIBRARY_DEPENDENCIES ${CMAKE_DL_LIBS})
bihive_require_header(valijson/validator.hpp libvalijson-dev)
bihive_require_header(gemmi/pdb.hpp gemmi-dev)
bihive_require_header(tao/pegtl.hpp tao-pegtl-dev)
target_compile_definitions(bihive_options INTERFACE BIHIVE_HAS_ZLIB=1 BIHIVE_HAS_PNG=1)

if(BIHIVE_BUILD_CLI)
  bihive_require(CLI11 libcli11-dev)
  bihive_require_header(boost/beast/http.hpp libboost-dev)
  list(APPEND BIHIVE_CLI_DEPENDENCIES CLI11::CLI11 ZLIB::ZLIB fmt::fmt nlohmann_json::nlohmann_json)
endif()
if(BIHIVE_BUILD_TESTS)
  find_package(GTest QUIET)
  if(NOT TARGET GTest::gmock_main)
    message(FATAL_ERROR "GoogleTest was not found. On Debian or Ubuntu: apt-get install libgtest-dev libgmock-dev, "
                        "or scripts/setup all for everything that the tests need.")
  endif()
endif()

# Results are not cached, so that the next configuration finds packages that were installed later.
# The window is built if GLFW and Dear ImGui are installed; nothing else needs them.
set(BIHIVE_BUILD_VIEWER AUTO CACHE STRING "Build bihive-view (needs GLFW and Dear ImGui): ON, OFF, or AUTO: where they are")
set(viewer_can_be_built OFF)
if(BIHIVE_BUILD_CLI AND NOT BIHIVE_SANITIZE)
  find_package(glfw3 3.3 QUIET)
  find_path(BIHIVE_IMGUI_FOLDER backends/imgui_impl_glfw.h PATH_SUFFIXES imgui)
  find_library(BIHIVE_IMGUI_LIBRARY imgui)
  find_library(BIHIVE_STB_LIBRARY stb) # ImGui uses its fonts and packing
  mark_as_advanced(BIHIVE_IMGUI_FOLDER BIHIVE_IMGUI_LIBRARY BIHIVE_STB_LIBRARY)
  if(glfw3_FOUND AND BIHIVE_IMGUI_FOLDER AND BIHIVE_IMGUI_LIBRARY AND BIHIVE_STB_LIBRARY)
    set(viewer_can_be_built ON)
  endif()
endif()
if(BIHIVE_BUILD_VIEWER STREQUAL "AUTO")
  set(BIHIVE_BUILD_VIEWER ${viewer_can_be_built})
elseif(BIHIVE_BUILD_VIEWER AND NOT viewer_can_be_built)
  message(FATAL_ERROR "GLFW or Dear ImGui was not found. On Debian or Ubuntu: apt-get install libglfw3-dev libimgui-dev, "
                      "or scripts/setup view.")
endif()
if(BIHIVE_BUILD_VIEWER)
  add_library(bihive_imgui INTERFACE)
  target_include_directories(bihive_imgui SYSTEM INTERFACE ${BIHIVE_IMGUI_FOLDER} ${BIHIVE_IMGUI_FOLDER}/backends)
  target_link_libraries(bihive_imgui INTERFACE ${BIHIVE_IMGUI_LIBRARY} ${BIHIVE_STB_LIBRARY} ${CMAKE_DL_LIBS} m)
endif()

# The benchmark is built if Embree is installed; nothing else needs it.
set(BIHIVE_BUILD_BENCH AUTO CACHE STRING "Build bihive-bench (needs Embree 3): ON, OFF, or AUTO: where it is")
set(bench_can_be_built OFF)
if(BIHIVE_BUILD_CLI AND NOT BIHIVE_SANITIZE AND NOT BIHIVE_OWN_POOL)
  find_package(embree 3 QUIET)
  set(bench_can_be_built ${embree_FOUND})
endif()
if(BIHIVE_BUILD_BENCH STREQUAL "AUTO")
  set(BIHIVE_BUILD_BENCH ${bench_can_be_built})
elseif(BIHIVE_BUILD_BENCH AND NOT bench_can_be_built)
  message(FATAL_ERROR "Embree 3 was not found. On Debian or Ubuntu: apt-get install libembree-dev, or scripts/setup bench.")
endif()
