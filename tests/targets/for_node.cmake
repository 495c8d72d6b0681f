# bihive_for_node(program): links a WebAssembly program for node. Its main function runs in a worker, so that it may
# wait for threads.
set(BIHIVE_BEFORE_NODE ${CMAKE_CURRENT_LIST_DIR}/before_node.js)
function(bihive_for_node program)
  target_link_options(
    ${program}
    PRIVATE
    -sPROXY_TO_PTHREAD=1
    -sPTHREAD_POOL_SIZE=6
    -sINITIAL_MEMORY=268435456
    -sEXIT_RUNTIME=1
    -sENVIRONMENT=node,worker
    --pre-js=${BIHIVE_BEFORE_NODE})
  set_target_properties(${program} PROPERTIES LINK_DEPENDS ${BIHIVE_BEFORE_NODE})
endfunction()
