# What makes faults of memory harder to use, and keeps the folders of the build out of what users get: for builds that are
# optimised, on Linux. Sanitizers, fuzzers, WebAssembly and builds for other machines go without.
# tests/install/hardening_test.py checks the programs and libraries.

option(BIHIVE_HARDENING "Stack protector, checked functions of the C library, PIE and full RELRO, no folders of the build" ON)

if(BIHIVE_HARDENING AND NOT EMSCRIPTEN AND NOT CMAKE_CROSSCOMPILING AND NOT BIHIVE_SANITIZE AND NOT BIHIVE_BUILD_FUZZERS
   AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  # Programs are loaded at random addresses (PIE).
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)

  # Functions with arrays notice that they wrote beyond them; functions of the C library know the size of what they write
  # to. A distribution may have chosen a higher level.
  target_compile_options(bihive_options INTERFACE -fstack-protector-strong)
  if(NOT "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE} ${CMAKE_CXX_FLAGS_RELWITHDEBINFO}" MATCHES "_FORTIFY_SOURCE")
    target_compile_options(
      bihive_options INTERFACE $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>)
  endif()

  # Tables of functions in other libraries are filled at the start, and cannot be written to afterwards (full RELRO).
  target_link_options(bihive_options INTERFACE LINKER:-z,relro LINKER:-z,now)

  # Debug information names files from the top of the sources; without it nothing does (base/check.h). Not in release
  # builds, where the folders in these words would keep a compiler cache from serving another clone.
  target_compile_options(
    bihive_options INTERFACE $<$<CONFIG:RelWithDebInfo>:-ffile-prefix-map=${PROJECT_BINARY_DIR}/=;-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=>)
endif()
