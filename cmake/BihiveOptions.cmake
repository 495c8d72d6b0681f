# The switches of the build, and the compile options that every target of the project shares (bihive_options).

include(GNUInstallDirs)

# Inside another project only the library is built, and nothing installed, unless that project overrides it.
option(BIHIVE_BUILD_CLI "Build the bihive program" ${PROJECT_IS_TOP_LEVEL})
option(BIHIVE_BUILD_C "Build the library for C (bihive.h)" ${PROJECT_IS_TOP_LEVEL})
option(BIHIVE_INSTALL "Install the library, its headers and what else is built" ${PROJECT_IS_TOP_LEVEL})
option(BIHIVE_BUILD_TESTS "Build the tests (needs GoogleTest)" OFF)
option(BIHIVE_BUILD_FUZZERS "Build the fuzz targets (needs clang)" OFF)
option(BIHIVE_FUZZ_SANITIZE "Fuzz targets with address and undefined behaviour sanitizers; without them more inputs per second" ON)
# BIHIVE_WERROR in the environment is its default, for builds that are begun by a script.
set(BIHIVE_WERROR_DEFAULT OFF)
if(DEFINED ENV{BIHIVE_WERROR})
  set(BIHIVE_WERROR_DEFAULT $ENV{BIHIVE_WERROR})
endif()
set(BIHIVE_COMPILE_TOGETHER_DEFAULT OFF)
# A sanitizer's build is compiled as a whole too, once before its tests.
if(CMAKE_BUILD_TYPE STREQUAL "Release" OR BIHIVE_SANITIZE)
  set(BIHIVE_COMPILE_TOGETHER_DEFAULT ON)
endif()
option(BIHIVE_WERROR "Treat warnings as errors" ${BIHIVE_WERROR_DEFAULT})
option(BIHIVE_COMPILE_TOGETHER "Compile neighbouring source files together: all at once in less time, one of them in more"
       ${BIHIVE_COMPILE_TOGETHER_DEFAULT})
set(BIHIVE_SANITIZE "" CACHE STRING "Sanitizers: empty, asan (address and undefined behaviour) or tsan (threads)")
set_property(CACHE BIHIVE_SANITIZE PROPERTY STRINGS "" asan tsan)
option(BIHIVE_SANITIZE_ALL "With the address sanitizer: build tests of arithmetic, pictures and texts too" ON)

set(BIHIVE_MPI AUTO CACHE STRING "The program bihive-mpi: ON, OFF, or AUTO: where MPI is found")
set_property(CACHE BIHIVE_MPI PROPERTY STRINGS AUTO ON OFF)

# Builds for another machine have no libraries of that machine. Header-only libraries are enough for pictures in memory.
set(BIHIVE_BARE OFF)
if(EMSCRIPTEN OR CMAKE_CROSSCOMPILING)
  set(BIHIVE_BARE ON)
endif()

# oneTBB does not link under WebAssembly, and ThreadSanitizer reports it because it is not instrumented.
set(BIHIVE_OWN_POOL_DEFAULT OFF)
if(BIHIVE_BARE OR BIHIVE_SANITIZE STREQUAL "tsan")
  set(BIHIVE_OWN_POOL_DEFAULT ON)
endif()
option(BIHIVE_OWN_POOL "Use the library's own threads instead of oneTBB" ${BIHIVE_OWN_POOL_DEFAULT})

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(bihive_options INTERFACE)

# The same bits everywhere: no fused multiply-add and no fast-math.
target_compile_options(bihive_options INTERFACE -ffp-contract=off)
# GCC 12 drops the rounding of a binary64 number to binary32 and back when it turns neighbouring conversions into a
# vector of two (tests/unit/vec3_test.cpp). Later versions were not checked, so this optimisation is off for all of
# them.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(bihive_options INTERFACE -fno-tree-slp-vectorize)
endif()
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE}" MATCHES "-ffast-math|-Ofast|-funsafe-math")
  message(FATAL_ERROR "bihive's pictures depend on exact IEEE arithmetic: remove -ffast-math or -Ofast from the flags")
endif()

# Instruction sets that every machine of the last ten years exceeds (src/bihive/simd/target.h).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  # NEON alone: every such machine has it. Vectors whose length is known only when the program runs (SVE) cannot be kept
  # in arrays, as the wide engine keeps them. Without the second macro Highway would compile for NEON with cryptography,
  # and a Raspberry Pi 4 has none.
  target_compile_definitions(
    bihive_options INTERFACE "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)"
                             TOOLCHAIN_MISS_SYS_AUXV_H)
else()
  # No machine runs the code for SSSE3: simd/target.cpp has no name for it.
  set(left_out HWY_SSSE3)
  if(BIHIVE_SANITIZE STREQUAL "tsan" OR (BIHIVE_SANITIZE STREQUAL "asan" AND NOT BIHIVE_SANITIZE_ALL))
    # Threads meet in the same places whatever the instruction set, and the others are the same code with other numbers of
    # lanes: AVX2, and code without vectors beside it, are enough. Half of the time of these builds went into the rest.
    list(APPEND left_out HWY_SSE4 HWY_AVX3)
  elseif(BIHIVE_SANITIZE STREQUAL "asan")
    list(APPEND left_out HWY_SSE4)
  endif()
  list(JOIN left_out "|" left_out)
  target_compile_definitions(bihive_options INTERFACE "HWY_DISABLED_TARGETS=(${left_out})")
endif()

target_compile_options(bihive_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 reports overlaps in string concatenations that have none (GCC bug 105651).
  target_compile_options(bihive_options INTERFACE -Wno-restrict)
endif()
if(BIHIVE_WERROR)
  target_compile_options(bihive_options INTERFACE -Werror)
endif()

if(BIHIVE_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # These warnings are wrong about instrumented code.
  target_compile_options(bihive_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overread
                                                -Wno-stringop-overflow)
endif()
if(BIHIVE_SANITIZE STREQUAL "asan")
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=address,undefined)
  # The checks' own data hold four million addresses, which the loader of a position-independent program would have to
  # write at each start (0.3 s); the tests start it some thousand times.
  string(APPEND CMAKE_EXE_LINKER_FLAGS " -no-pie")
  # Finds an index beyond the end of a vector, even if the memory after it is valid.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
elseif(BIHIVE_SANITIZE STREQUAL "tsan")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=thread)
elseif(BIHIVE_SANITIZE)
  message(FATAL_ERROR "BIHIVE_SANITIZE is '${BIHIVE_SANITIZE}': expected nothing, asan or tsan")
endif()

if(BIHIVE_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang" OR EMSCRIPTEN)
    message(FATAL_ERROR "libFuzzer comes with clang: configure with -DCMAKE_CXX_COMPILER=clang++ (Debian package clang, "
                        "or run scripts/setup all)")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link -g1)
  if(BIHIVE_FUZZ_SANITIZE)
    add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all)
    add_link_options(-fsanitize=address,undefined)
  else()
    # An index beyond the end of a vector still ends the program.
    add_compile_definitions(_GLIBCXX_ASSERTIONS)
  endif()
endif()
