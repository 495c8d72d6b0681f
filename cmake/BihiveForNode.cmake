# bihive_for_node(program): links a WebAssembly program to be run under node. Its main function runs in a worker, so that
# it may wait for threads.
function(bihive_for_node program)
  set(before ${PROJECT_SOURCE_DIR}/tests/wasm/before.js)
  target_link_options(
    ${program}
    PRIVATE
    -sPROXY_TO_PTHREAD=1
    -sPTHREAD_POOL_SIZE=6
    -sINITIAL_MEMORY=268435456
    -sEXIT_RUNTIME=1
    -sENVIRONMENT=node,worker
    --pre-js=${before})
  set_target_properties(${program} PROPERTIES LINK_DEPENDS ${before})
endfunction()
