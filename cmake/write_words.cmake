# Run by bihive_words: PROGRAM writes its manual pages and completions into FOLDER, as they are installed below share and
# share/man.

file(REMOVE_RECURSE ${FOLDER})
function(describe file)
  cmake_path(GET file PARENT_PATH folder)
  file(MAKE_DIRECTORY ${FOLDER}/${folder})
  execute_process(COMMAND ${PROGRAM} describe ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

execute_process(COMMAND ${PROGRAM} describe commands OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" commands "${commands}")
describe(man1/bihive.1 man)
foreach(command ${commands})
  describe(man1/bihive-${command}.1 man ${command})
endforeach()
describe(bash-completion/completions/bihive bash)
describe(zsh/site-functions/_bihive zsh)
describe(fish/vendor_completions.d/bihive.fish fish)
file(TOUCH ${FOLDER}/written)
