# bihive_embed(target file HEADER header FUNCTION function)
#
# Makes the bytes of `file` part of `target`: generates, at build time, a source file that defines
# `std::string_view bihive::function()`, which `header` declares.

function(bihive_embed target file)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "HEADER;FUNCTION" "")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${arg_FUNCTION}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_file.cmake)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DINPUT=${file} -DOUTPUT=${output} -DHEADER=${arg_HEADER} -DFUNCTION=${arg_FUNCTION} -P
            ${script}
    DEPENDS ${file} ${script}
    COMMENT "Embedding ${file}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
