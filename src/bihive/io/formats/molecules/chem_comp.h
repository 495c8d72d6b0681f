// CIF of monomers: a reader beside those of mmCIF and of crystals.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bihive/base/result.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// The atoms of a monomer: its ideal coordinates, else those of a structure. Each data block with coordinates is a
/// frame. Nothing: no block has any. Throws what gemmi's parser throws.
Result<std::optional<RawSpheres>> read_chem_comp(std::string_view text, const std::string& file, std::int64_t frame);

}  // namespace bihive
