// CIF: one beginning, two readers.
#pragma once

#include "bihive/io/formats/format.h"

namespace bihive {

/// Whether a text begins as CIF, after comments.
bool is_cif(const FileHead& head);
/// Whether a CIF has fractional coordinates, anywhere in it: then it is one of small molecules or crystals.
bool is_small_cif(std::string_view text);
/// The whole cell, by its symmetry; each data block with atoms is a frame.
Result<RawSpheres> read_small_cif(std::string_view text, const std::string& file, std::int64_t frame);

}  // namespace bihive
