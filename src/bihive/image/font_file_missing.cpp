// Builds without FreeType: the page, other processors, and where libfreetype-dev is not installed.
#include "bihive/image/font_file.h"

namespace bihive {

Result<std::shared_ptr<const Font>> read_font(const std::string& path) {
  return Error{"this build of bihive reads no fonts", path, 0, 0,
               "install libfreetype-dev (scripts/setup demo) and build again, or use the built-in DejaVu Sans"};
}

}  // namespace bihive
