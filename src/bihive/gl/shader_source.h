// The text of a shader, assembled from chunks that include each other by name.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"

namespace bihive {

struct ShaderSource {
  /// The origin of a line of the text: chunk and line, counted from 1. Empty: no chunk.
  struct Origin {
    std::string chunk;
    std::int64_t line = 0;
  };
  std::string text;
  std::vector<Origin> lines;        ///< of the text
  std::vector<std::string> chunks;  ///< in the order in which they begin

  /// A compiler's messages with the chunk and its line instead of the text's line: "0:213(7): error" becomes
  /// "sphere.glsl:13(7): error". (#line would do the same if all drivers obeyed it: Mesa forgets the chunk's number.)
  std::string with_names(std::string_view log) const;
};

/// The text of a chunk by its name, or nothing.
using ChunkFinder = std::function<std::optional<std::string_view>(std::string_view name)>;

/// The chunk `name` after "#version 300 es" and a #define for each of `defines` ("STACK_SIZE 32"). The first line
/// `#include "other"` becomes the chunk `other`; later ones become nothing. So a chunk that two branches of an #if need
/// must be included before the #if. Error: there is no such chunk; it names file and line of the #include.
Result<ShaderSource> assemble_shader(std::string_view name, const std::vector<std::string>& defines,
                                     const ChunkFinder& find);
/// As above, from the library's own chunks.
Result<ShaderSource> assemble_shader(std::string_view name, const std::vector<std::string>& defines);

}  // namespace bihive
