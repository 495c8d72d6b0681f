# Headers that nearly every source file includes are read once and kept (precompiled). Sources still include what they use:
# builds without it (-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON: scripts/lint, and other machines' builds) fail where one does not.

set(BIHIVE_OFTEN_INCLUDED
    <algorithm>
    <array>
    <cmath>
    <cstdint>
    <cstring>
    <functional>
    <limits>
    <memory>
    <optional>
    <string>
    <string_view>
    <utility>
    <vector>)

# bihive_precompile(target [HEADER...]): those above, and more.
function(bihive_precompile target)
  if(BIHIVE_BARE)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE ${BIHIVE_OFTEN_INCLUDED} ${ARGN})
  bihive_quiet_with_precompiled(${target})
endfunction()

# bihive_compile_together(target [COUNT]): eight (or COUNT) neighbouring source files are compiled as one, because reading the
# same headers again and again took most of the time. Files that Highway includes into themselves, once for each instruction set, stay
# alone, and so do files with flags of their own and those that say SKIP_UNITY_BUILD_INCLUSION. A name in an anonymous namespace
# must then differ from those of the neighbours. CMake's own UNITY_BUILD names the files by whole paths, so no compiler cache
# knows them in another clone; here they are named from the tops of the sources and of the build. Call it after the target
# has all its sources.
function(bihive_compile_together target)
  if(NOT BIHIVE_COMPILE_TOGETHER)
    return()
  endif()
  set(most 8)
  if(ARGC GREATER 1)
    set(most ${ARGV1})
  endif()
  get_target_property(sources ${target} SOURCES)
  set(alone "")
  set(together "")
  foreach(source ${sources})
    set(stays_alone OFF)
    foreach(property COMPILE_OPTIONS COMPILE_DEFINITIONS INCLUDE_DIRECTORIES SKIP_UNITY_BUILD_INCLUSION)
      get_source_file_property(value ${source} ${property})
      if(value)
        set(stays_alone ON)
      endif()
    endforeach()
    get_source_file_property(is_generated ${source} GENERATED)
    if(NOT source MATCHES "^/.*\\.cpp$")
      set(stays_alone ON)
    elseif(NOT is_generated)
      file(STRINGS ${source} once_for_each_target REGEX "hwy/foreach_target" LIMIT_COUNT 1)
      if(once_for_each_target)
        set(stays_alone ON)
      endif()
    endif()
    if(stays_alone)
      list(APPEND alone ${source})
    else()
      list(APPEND together ${source})
    endif()
  endforeach()
  set(number 0)
  list(LENGTH together left)
  while(left GREATER 0)
    math(EXPR first "${most} * ${number}")
    math(EXPR left "${left} - ${most}")
    list(SUBLIST together ${first} ${most} batch)
    set(text "")
    set(generated "")
    foreach(source ${batch})
      get_source_file_property(is_generated ${source} GENERATED)
      set(top ${PROJECT_SOURCE_DIR})
      if(is_generated)
        set(top ${PROJECT_BINARY_DIR})
        list(APPEND generated ${source})
      endif()
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${top})
      string(APPEND text "#include \"${source}\"\n")
    endforeach()
    set(file ${CMAKE_CURRENT_BINARY_DIR}/together/${target}_${number}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    set_source_files_properties(${file} PROPERTIES OBJECT_DEPENDS "${generated}")
    list(APPEND alone ${file})
    math(EXPR number "${number} + 1")
  endwhile()
  set_target_properties(${target} PROPERTIES SOURCES "${alone}")
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
  # Hidden implementations may hold types of anonymous namespaces: each stays within its source file.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# bihive_optimise_little(target): for code that parses and prints text, most of it by templates of others (CLI11,
# Boost.Beast, JSON). Compiling it took more processor time than the kernels did, and running it takes next to none.
function(bihive_optimise_little target)
  if(BIHIVE_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# GCC 12 forgets that precompiled headers of the system's are the system's, and complains of its own std::string. Builds
# without precompiled headers keep these warnings; the one for 64-bit ARM compiles the library and the tests of the kernels
# (tests/targets/run_neon).
function(bihive_quiet_with_precompiled target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
     AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()
