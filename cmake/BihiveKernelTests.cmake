# The tests of the kernels (tests/kernel_tests.txt) for another machine than this one, with GoogleTest compiled along from
# the sources that come with Debian's libgtest-dev (without them there are no tests: the page needs none); and
# picture_hash, which prints the hashes of pictures.
#
# add_kernel_tests(): the programs, in the current folder's binary folder. Their names go to BIHIVE_KERNEL_TEST_TARGETS.
set(BIHIVE_GOOGLETEST_SOURCES /usr/src/googletest CACHE PATH "The sources of GoogleTest")

macro(add_kernel_tests)
  add_library(bihive_test_support INTERFACE)
  target_include_directories(bihive_test_support INTERFACE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(bihive_test_support INTERFACE BIHIVE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(bihive_test_support INTERFACE bihive_lib bihive_options ${BIHIVE_LIBRARY_DEPENDENCIES})

  add_executable(picture_hash ${PROJECT_SOURCE_DIR}/tests/wasm/picture_hash.cpp)
  target_link_libraries(picture_hash PRIVATE bihive_test_support)
  set(BIHIVE_KERNEL_TEST_TARGETS picture_hash)

  set(lines)
  if(EXISTS ${BIHIVE_GOOGLETEST_SOURCES}/CMakeLists.txt)
    add_subdirectory(${BIHIVE_GOOGLETEST_SOURCES} ${CMAKE_CURRENT_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
    file(STRINGS ${PROJECT_SOURCE_DIR}/tests/kernel_tests.txt lines REGEX "^[a-z]")
  endif()
  foreach(line ${lines})
    string(REGEX MATCH "^[^ ]+" test "${line}")
    string(REPLACE "/" "_" name ${test}_test)
    add_executable(${name} ${PROJECT_SOURCE_DIR}/tests/${test}_test.cpp)
    target_link_libraries(${name} PRIVATE bihive_test_support gmock_main)
    list(APPEND BIHIVE_KERNEL_TEST_TARGETS ${name})
  endforeach()
endmacro()
