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

# bihive_optimise_little(target): for code that reads words and writes text, most of it by templates of others (CLI11,
# Boost.Beast, JSON). Compiling it took more processor time than the kernels did, and running it takes next to none.
function(bihive_optimise_little target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
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
