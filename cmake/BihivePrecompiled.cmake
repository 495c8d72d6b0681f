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

# bihive_compile_together(target [ALONE REGEX]): eight neighbouring source files are compiled as one, because reading the
# same headers again and again took most of the time. Files that Highway includes into themselves, once for each
# instruction set, stay alone, and so do those that the regular expression matches. A name in an anonymous namespace must
# then differ from those of the neighbours.
function(bihive_compile_together target)
  cmake_parse_arguments(PARSE_ARGV 1 together "" ALONE "")
  if(NOT BIHIVE_COMPILE_TOGETHER)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    if(NOT source MATCHES "\\.cpp$" OR NOT IS_ABSOLUTE ${source} OR NOT EXISTS ${source})
      continue()
    endif()
    file(STRINGS ${source} once_for_each_target REGEX "hwy/foreach_target" LIMIT_COUNT 1)
    if(once_for_each_target OR (together_ALONE AND source MATCHES "${together_ALONE}"))
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  # Hidden implementations may hold types of anonymous namespaces: each stays within its source file.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# bihive_optimise_little(target): for code that reads words and writes text, most of it by templates of others (CLI11,
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
