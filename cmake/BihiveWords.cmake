# Manual pages and completions: the built program writes them from the same words as --help, whenever it is built anew.

set(words_folder ${PROJECT_BINARY_DIR}/words)
add_custom_command(
  OUTPUT ${words_folder}/written
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:bihive> -DFOLDER=${words_folder} -P
          ${PROJECT_SOURCE_DIR}/cmake/write_words.cmake
  DEPENDS bihive ${PROJECT_SOURCE_DIR}/cmake/write_words.cmake
  COMMENT "Writing manual pages and completions"
  VERBATIM)
add_custom_target(bihive_words ALL DEPENDS ${words_folder}/written)

install(DIRECTORY ${words_folder}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT bihive)
install(DIRECTORY ${words_folder}/bash-completion ${words_folder}/zsh ${words_folder}/fish
        DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT bihive)
