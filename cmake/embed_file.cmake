# Run by bihive_embed(): writes OUTPUT, which defines bihive::FUNCTION() to return the bytes of INPUT.

file(READ ${INPUT} bytes HEX)
file(SIZE ${INPUT} size)

# An array of characters, 24 a line, and a final 0 so that the array is never empty.
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
string(REGEX REPLACE "(('[^']*',){1,24})" "\\1\n" bytes "${bytes}")
cmake_path(GET INPUT FILENAME name)
file(WRITE ${OUTPUT} "// Generated from ${name}.
#include <string_view>

#include \"${HEADER}\"

namespace bihive {
namespace {

constexpr char ${FUNCTION}_bytes[] = {
${bytes}'\\0'};

}  // namespace

std::string_view ${FUNCTION}() {
  return {${FUNCTION}_bytes, ${size}};
}

}  // namespace bihive
")
