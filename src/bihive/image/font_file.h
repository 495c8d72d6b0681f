// Fonts from files, for letters that DejaVu Sans lacks or that should look like those of a journal (FreeType).
#pragma once

#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/image/font.h"

namespace bihive {

/// Opens a TrueType, OpenType or Type 1 font, of a collection the first one. Outlines are unscaled and without hints,
/// so that letters depend on the file alone. Errors: an unreadable file; no font; no outlines, or no Unicode; a build
/// without FreeType.
Result<std::shared_ptr<const Font>> read_font(const std::string& path);

}  // namespace bihive
