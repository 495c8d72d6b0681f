# What the fuzz target `target` of the file NAME_fuzz.cpp needs beyond the readers; `name` is NAME.
if(TARGET bihive_engines AND name MATCHES "^(sets|rays|picture)$")
  target_link_libraries(${target} PRIVATE bihive_engines)
endif()
if(name STREQUAL "http")
  # The server without its sockets.
  foreach(part answer url addresses page_files named_file)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/apps/cli/server/${part}.cpp)
  endforeach()
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/apps/cli)
  target_compile_definitions(${target} PRIVATE BIHIVE_SHARE_FOLDER="share")
  target_link_libraries(${target} PRIVATE ${BIHIVE_CLI_DEPENDENCIES} ${BIHIVE_LIBRARY_DEPENDENCIES})
endif()
