# The functions that declare tests.

# The name of the test in a file: unit.tree for tests/unit/tree_test.cpp; kind and target too if asked for.
function(bihive_test_name file name)
  cmake_path(GET file STEM stem)
  cmake_path(GET file PARENT_PATH folder)
  cmake_path(GET folder FILENAME kind)
  string(REGEX REPLACE "_test$" "" subject ${stem})
  set(${name} ${kind}.${subject} PARENT_SCOPE)
  if(ARGC GREATER 2)
    set(${ARGV2} ${kind} PARENT_SCOPE)
    set(${ARGV3} ${kind}_${stem} PARENT_SCOPE)
  endif()
endfunction()

# add_bihive_test(file): tests/unit/tree_test.cpp becomes the program unit_tree_test and the ctest entry unit.tree with
# the label unit. Programs get GoogleTest, GoogleMock, the library, and the helpers in tests/support.
function(add_bihive_test file)
  bihive_test_name(${file} name kind target)
  add_executable(${target} ${file})
  target_link_libraries(${target} PRIVATE bihive_test_support GTest::gmock_main)
  if(NOT name IN_LIST BIHIVE_TESTS_OF_INLINE_CODE)
    bihive_compile_as_test(${target})
  endif()
  add_test(NAME ${name} COMMAND ${target})
  set_tests_properties(${name} PROPERTIES LABELS ${kind} TIMEOUT 1800 ENVIRONMENT "${BIHIVE_TEST_ENVIRONMENT}")
endfunction()

# Tests of arithmetic that is compiled into whoever calls it: it must be optimised as it is for users, so that what a
# compiler does to it is seen (vec3_test.cpp holds such a find).
set(BIHIVE_TESTS_OF_INLINE_CODE
    unit.elementary
    unit.ray
    unit.shading
    unit.sphere
    unit.vec3
    unit.wave_lanes
    unit.wave_powers
    property.beam_bounds
    property.filter_bounds)

# What calls the library, whose code is optimised as ever, need not be quick itself: compiling it is what takes time.
function(bihive_compile_as_test target)
  target_compile_options(${target} PRIVATE -O1)
  target_precompile_headers(${target} REUSE_FROM bihive_test_support)
  bihive_quiet_with_precompiled(${target})
endfunction()

# add_bihive_script_test(file): a Python test, run with BIHIVE, BIHIVE_VIEW and BIHIVE_BENCH (the built programs) and BIHIVE_SOURCE
# (the top of the sources) in its environment.
function(add_bihive_script_test file)
  bihive_test_name(${file} name kind target)
  set(environment ${BIHIVE_TEST_ENVIRONMENT})
  # The search for leaks takes 0.2 s at the end of each of thousands of processes; programs of C++ are searched (unit, property).
  if(BIHIVE_SANITIZE STREQUAL "asan")
    list(APPEND environment "ASAN_OPTIONS=detect_leaks=0")
  endif()
  if(TARGET bihive)
    list(APPEND environment "BIHIVE=$<TARGET_FILE:bihive>")
  endif()
  if(TARGET bihive-view)
    list(APPEND environment "BIHIVE_VIEW=$<TARGET_FILE:bihive-view>")
  endif()
  if(TARGET bihive-mpi)
    list(APPEND environment "BIHIVE_MPI=$<TARGET_FILE:bihive-mpi>")
  endif()
  if(TARGET bihive-bench)
    list(APPEND environment "BIHIVE_BENCH=$<TARGET_FILE:bihive-bench>")
  endif()
  add_test(NAME ${name} COMMAND ${Python_EXECUTABLE} ${file} -v)
  set_tests_properties(${name} PROPERTIES LABELS ${kind} TIMEOUT 1800 ENVIRONMENT "${environment}")
endfunction()
