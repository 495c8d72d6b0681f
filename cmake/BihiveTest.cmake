# The functions that declare tests. A file tests/KIND/SUBJECT_test.* is the ctest entry KIND.SUBJECT with the label KIND; the
# C++ files of a kind are one program, KIND_tests, and an entry runs the tests of its file alone (tests/test_main.cpp).
#
# Properties of a test are in its file, in lines `// ctest: ...` (Python: `# ctest: ...`), which CMake reads when it is
# run, as scripts/test and scripts/check do:
#   inlined          its code is compiled into whoever calls it: as users compile it, in the program inlined_tests
#   kernel [PATTERN] also where an instruction set is emulated (tests/targets), there without the tests of this pattern
#   threads          also with the thread sanitizer
#   alone            not compiled together with its neighbours (bihive_compile_together)
#   no-sanitizer     without sanitizers alone
#   asan-long        C++: with the address sanitizer in `make test-all` alone (not with BIHIVE_SANITIZE_ALL=OFF)
#   needs TARGET     where CMake has this target; C++ is linked to it
#   PROPERTY VALUE   a property of the ctest entry, in capitals: COST 700, RUN_SERIAL TRUE, LABELS long

set(BIHIVE_TEST_ENVIRONMENT "BIHIVE_SOURCE=${PROJECT_SOURCE_DIR}")
# Drivers leak as they like: where a sanitizer watches, there is no EGL. What needs one is labelled gl.
if(BIHIVE_SANITIZE)
  list(APPEND BIHIVE_TEST_ENVIRONMENT "BIHIVE_EGL=/nowhere")
endif()

# bihive_test_notes(file prefix): the notes of a file. Sets PREFIX_inlined, PREFIX_kernel and so on to ON, PREFIX_pattern and
# PREFIX_needs to what follows these words, PREFIX_properties to the list of properties.
function(bihive_test_notes file prefix)
  foreach(flag inlined kernel threads alone no-sanitizer asan-long)
    set(${prefix}_${flag} OFF PARENT_SCOPE)
  endforeach()
  foreach(value pattern needs properties)
    set(${value} "")
  endforeach()
  file(STRINGS ${file} lines REGEX "^(//|#) ctest: ")
  foreach(line ${lines})
    string(REGEX REPLACE "^(//|#) ctest: +" "" line "${line}")
    separate_arguments(words UNIX_COMMAND "${line}")
    list(POP_FRONT words key)
    if(key MATCHES "^(inlined|threads|alone|no-sanitizer|asan-long)$" AND NOT words)
      set(${prefix}_${key} ON PARENT_SCOPE)
    elseif(key STREQUAL "kernel")
      set(${prefix}_kernel ON PARENT_SCOPE)
      set(pattern "${words}")
    elseif(key STREQUAL "needs" AND words)
      list(APPEND needs ${words})
    elseif(key MATCHES "^[A-Z_]+$" AND words)
      list(APPEND properties ${key} "${words}")
    else()
      message(FATAL_ERROR "${file}: 'ctest: ${line}': cmake/BihiveTest.cmake has no such note")
    endif()
  endforeach()
  foreach(value pattern needs properties)
    set(${prefix}_${value} "${${value}}" PARENT_SCOPE)
  endforeach()
endfunction()

# The name of the test in a file: unit.tree for tests/unit/tree_test.cpp.
function(bihive_test_name file name)
  cmake_path(GET file STEM stem)
  cmake_path(GET file PARENT_PATH folder)
  cmake_path(GET folder FILENAME kind)
  string(REGEX REPLACE "_test$" "" subject ${stem})
  set(${name} ${kind}.${subject} PARENT_SCOPE)
endfunction()

# Whether a file is tested in this build: a sanitizer takes what is its to find, and other things may not be there.
function(bihive_is_tested notes result)
  set(${result} ON)
  if(BIHIVE_SANITIZE AND ${notes}_no-sanitizer)
    set(${result} OFF)
  elseif(BIHIVE_SANITIZE STREQUAL "tsan" AND NOT ${notes}_threads)
    set(${result} OFF)
  elseif(BIHIVE_SANITIZE STREQUAL "asan" AND NOT BIHIVE_SANITIZE_ALL AND ${notes}_asan-long)
    set(${result} OFF)
  endif()
  foreach(target ${${notes}_needs})
    if(NOT TARGET ${target})
      set(${result} OFF)
    endif()
  endforeach()
  set(${result} ${${result}} PARENT_SCOPE)
endfunction()

# add_bihive_tests(KIND): the program KIND_tests and its entries. `inlined` files of all kinds are one more program. Programs
# get GoogleTest, GoogleMock, the library, and the helpers in tests/support.
function(add_bihive_tests kind)
  file(GLOB files CONFIGURE_DEPENDS ${kind}/*_test.cpp)
  foreach(file ${files})
    bihive_test_notes(${file} notes)
    bihive_is_tested(notes is_tested)
    if(NOT is_tested)
      continue()
    endif()
    set(program ${kind}_tests)
    if(notes_inlined)
      set(program inlined_tests)
    endif()
    if(NOT TARGET ${program})
      add_executable(${program} ${CMAKE_CURRENT_SOURCE_DIR}/test_main.cpp)
      target_link_libraries(${program} PRIVATE bihive_test_support)
      if(NOT notes_inlined)
        bihive_compile_as_test(${program})
      endif()
    endif()
    target_sources(${program} PRIVATE ${file})
    set_source_files_properties(${file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ${notes_alone})
    target_link_libraries(${program} PRIVATE ${notes_needs})
    bihive_test_name(${file} name)
    string(REPLACE "." "/" of_file ${name})
    add_test(NAME ${name} COMMAND ${program} --file ${of_file})
    set_tests_properties(${name} PROPERTIES LABELS ${kind} TIMEOUT 1800 ENVIRONMENT "${BIHIVE_TEST_ENVIRONMENT}"
                                            ${notes_properties})
    if(notes_kernel)
      set_property(GLOBAL APPEND_STRING PROPERTY BIHIVE_KERNEL_TESTS "${program} ${of_file} ${notes_pattern}\n")
    endif()
  endforeach()
endfunction()

# What calls the library, whose code is optimised as usual, need not be fast itself: compiling it takes the time.
function(bihive_compile_as_test target)
  target_compile_options(${target} PRIVATE -O1)
  target_precompile_headers(${target} REUSE_FROM bihive_test_support)
  bihive_quiet_with_precompiled(${target})
endfunction()

# add_bihive_script_tests(KIND): tests in Python, run with BIHIVE, BIHIVE_VIEW, BIHIVE_MPI and BIHIVE_BENCH (the built
# programs) and BIHIVE_SOURCE (the top of the sources) in their environment, and what else is given.
function(add_bihive_script_tests kind)
  set(environment ${BIHIVE_TEST_ENVIRONMENT} ${ARGN})
  # The search for leaks takes 0.2 s at the end of each of thousands of processes; programs of C++ are searched (unit, property).
  if(BIHIVE_SANITIZE STREQUAL "asan")
    list(APPEND environment "ASAN_OPTIONS=detect_leaks=0")
  endif()
  foreach(program bihive bihive-view bihive-mpi bihive-bench)
    if(TARGET ${program})
      string(MAKE_C_IDENTIFIER ${program} variable)
      string(TOUPPER ${variable} variable)
      list(APPEND environment "${variable}=$<TARGET_FILE:${program}>")
    endif()
  endforeach()
  file(GLOB files CONFIGURE_DEPENDS ${kind}/*_test.py)
  foreach(file ${files})
    bihive_test_notes(${file} notes)
    set(label ${kind})
    set(missing "")
    foreach(target ${notes_needs})
      if(NOT TARGET ${target})
        set(missing ${target})
      endif()
    endforeach()
    if(missing)
      continue()
    endif()
    bihive_test_name(${file} name)
    add_test(NAME ${name} COMMAND ${Python_EXECUTABLE} ${file} -v)
    set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT 1800 ENVIRONMENT "${environment}" ${notes_properties})
  endforeach()
endfunction()
