# Run by bihive_embed(): writes OUTPUT, which defines bihive::FUNCTION() to return the bytes of INPUT; with COLUMNS
# those of the table whose columns INPUT has, one after the other, the last one of newlines.

file(READ ${INPUT} bytes HEX)
file(SIZE ${INPUT} size)

# An array of characters, 24 a line, and a final 0 so that the array is never empty.
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
string(REGEX REPLACE "(('[^']*',){1,24})" "\\1\n" bytes "${bytes}")
cmake_path(GET INPUT FILENAME name)
set(headers "")
set(body "  return {${FUNCTION}_bytes, ${size}};")
if(COLUMNS)
  set(headers "#include <cstddef>\n#include <string>\n")
  set(body "  static const std::string text = [] {
    const std::string_view columns(${FUNCTION}_bytes, ${size});
    const std::size_t rows = columns.size() - columns.find('\\n');
    std::string made;
    made.reserve(columns.size());
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t at = row; at < columns.size(); at += rows) made += columns[at];
    return made;
  }();
  return text;")
endif()
file(WRITE ${OUTPUT} "// Generated from ${name}.
${headers}#include <string_view>

#include \"${HEADER}\"

namespace bihive {
namespace {

constexpr char ${FUNCTION}_bytes[] = {
${bytes}'\\0'};

}  // namespace

std::string_view ${FUNCTION}() {
${body}
}

}  // namespace bihive
")
