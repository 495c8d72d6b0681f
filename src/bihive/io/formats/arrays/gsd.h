// Frames of GSD files of HOOMD-blue: places, types, sizes, and what else it knows of particles.
#pragma once

#include <cstdint>

#include "bihive/base/result.h"
#include "bihive/io/formats/arrays/gsd_file.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// The particles of a frame. Lengths in the file's own unit. Radii are half of `particles/diameter` where the file has
/// it. Errors: no such frame; another schema; arrays that do not fit each other.
/// The particles of `chunk` alone.
Result<RawSpheres> read_gsd_frame(const GsdFile& file, std::int64_t frame, RowChunk chunk = {});

}  // namespace bihive
