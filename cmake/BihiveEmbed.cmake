# bihive_embed(target file HEADER header FUNCTION function)
#
# Makes the bytes of `file` part of `target`: generates, at build time, a source file that defines
# `std::string_view bihive::function()`, which `header` declares. WEB form: in WebAssembly, which every visitor of the page
# downloads, the module holds the file in that form (cmake/shorten_for_web).

function(bihive_embed target file)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "HEADER;FUNCTION;WEB" "")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${arg_FUNCTION}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_file.cmake)
  set(bytes ${file})
  set(columns OFF)
  if(EMSCRIPTEN AND arg_WEB)
    set(shorten ${PROJECT_SOURCE_DIR}/cmake/shorten_for_web)
    set(bytes ${CMAKE_CURRENT_BINARY_DIR}/embedded/${arg_FUNCTION}.${arg_WEB})
    add_custom_command(
      OUTPUT ${bytes}
      COMMAND node ${shorten} ${arg_WEB} ${file} ${bytes}
      DEPENDS ${file} ${shorten}
      VERBATIM)
    string(COMPARE EQUAL ${arg_WEB} by_columns columns)
  endif()
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${bytes} -DOUTPUT=${output} -DHEADER=${arg_HEADER} -DFUNCTION=${arg_FUNCTION}
            -DCOLUMNS=${columns} -P ${script}
    DEPENDS ${bytes} ${script}
    COMMENT "Embedding ${file}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
