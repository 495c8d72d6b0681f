// Positions and their periodic cell: into the cell, or together again.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/io/raw_spheres.h"
#include "bihive/io/read_spheres.h"

namespace bihive {

/// Moves centres by whole vectors of raw.cell, in binary64 (docs/formats.md, "Periodic cells"). Error: there is no
/// cell, it has no volume, or, for unwrap, nothing says which spheres belong together. `name`: of the file.
Status apply_wrapping(RawSpheres& raw, Wrapping wrapping, const std::string& name);

}  // namespace bihive
