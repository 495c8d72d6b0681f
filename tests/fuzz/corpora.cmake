# The inputs that the fuzz targets begin with. Those that somebody named are files in corpus/NAME; those that a fuzzer found
# are in the archive corpus/NAME.tar.xz (scripts/pack_corpus), which is unpacked into the build folder.
#   bihive_corpora             the target that unpacks all of them
#   BIHIVE_UNPACKED_CORPORA    the folder of folders
#   bihive_corpus(NAME folders)   sets `folders` to those with the inputs of NAME

set(BIHIVE_UNPACKED_CORPORA ${PROJECT_BINARY_DIR}/corpora)
file(GLOB archives CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/corpus/*.tar.xz)
set(stamps "")
foreach(archive ${archives})
  cmake_path(GET archive STEM name)
  set(folder ${BIHIVE_UNPACKED_CORPORA}/${name})
  add_custom_command(
    OUTPUT ${folder}.unpacked
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${CMAKE_COMMAND} -E chdir ${folder} ${CMAKE_COMMAND} -E tar xf ${archive}
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}.unpacked
    DEPENDS ${archive}
    COMMENT "Unpacking ${archive}"
    VERBATIM)
  list(APPEND stamps ${folder}.unpacked)
endforeach()
add_custom_target(bihive_corpora ALL DEPENDS ${stamps})

set(BIHIVE_CORPORA ${CMAKE_CURRENT_LIST_DIR}/corpus)
function(bihive_corpus name folders)
  set(found "")
  if(IS_DIRECTORY ${BIHIVE_CORPORA}/${name})
    list(APPEND found ${BIHIVE_CORPORA}/${name})
  endif()
  if(EXISTS ${BIHIVE_CORPORA}/${name}.tar.xz)
    list(APPEND found ${BIHIVE_UNPACKED_CORPORA}/${name})
  endif()
  if(NOT found)
    message(FATAL_ERROR "The fuzz target ${name} has no inputs: put some into ${BIHIVE_CORPORA}/${name}")
  endif()
  set(${folders} ${found} PARENT_SCOPE)
endfunction()
