# Compile and link options of WebAssembly.

# Exceptions: the header-only libraries throw, and the library turns that into errors. They are WebAssembly's
# own: JavaScript's would send every call that may throw through JavaScript. SIMD, conversions of numbers that do not trap, extensions
# of signs and copies of memory: every browser of the last years has them. Threads are workers with shared memory; a page has them only
# if its server sends certain headers.
option(BIHIVE_WASM_THREADS "Build WebAssembly for several threads" ON)
add_compile_options(-fwasm-exceptions -msimd128 -mnontrapping-fptoint -msign-ext -mbulk-memory)
# Nobody asks what type a std::function holds: the names of those types are left out.
add_compile_definitions(_LIBCPP_NO_RTTI)
# fmt without locales.
add_compile_definitions(FMT_STATIC_THOUSANDS_SEPARATOR=',')
add_link_options(-fwasm-exceptions)
if(BIHIVE_WASM_THREADS)
  add_compile_options(-pthread)
  add_link_options(-pthread)
endif()

# wasm-opt would move every function that has one caller into that caller. The wide engine and the steps of a wave would
# become a single function, in which V8 keeps next to nothing in registers.
add_link_options(-sBINARYEN_EXTRA_PASSES=--one-caller-inline-max-function-size=1)

# Debian keeps the JavaScript modules that em++ needs for linking here.
if(IS_DIRECTORY /usr/share/nodejs)
  set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
endif()
