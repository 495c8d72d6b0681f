# bihive_embed_version(target): generates the definitions of bihive/base/version.h at build time, so that the commit is
# right although CMake was configured earlier. Without git, or outside a clone, the commit is empty.

function(bihive_embed_version target)
  find_package(Git QUIET)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/version.cpp)
  add_custom_target(
    ${target}_version
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${output} -DVERSION=${PROJECT_VERSION}
            -DGIT=${GIT_EXECUTABLE} -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
    BYPRODUCTS ${output}
    COMMENT "Looking up the commit"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
  set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON) # it changes with each commit
  add_dependencies(${target} ${target}_version)
endfunction()
